// A libFuzzer target for networks: whatever the bytes, they are read or refused. Built and run as
// fuzz_import.cpp says.
#include <cstdint>
#include <string_view>

#include "extract/pose/tflite/read.h"
#include "tests/support/fuzz.h"

namespace stride {

void network(std::string_view content) { tflite::read_tflite(content); }

}  // namespace stride

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return stride::read_or_refuse(data, size, stride::STRIDE_FUZZED_READER);
}
