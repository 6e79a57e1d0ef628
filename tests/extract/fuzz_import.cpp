// A libFuzzer target for each import format: whatever the bytes, a reader imports or throws Error.
//     cmake -B build/fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DSTRIDE_FUZZ=ON
//     cmake --build build/fuzz --target fuzz_import_sleap
//     build/fuzz/tests/extract/fuzz_import_sleap -max_total_time=600 CORPUS_FOLDER
#include <string_view>

#include "extract/import/formats/formats.h"
#include "extract/import/networks/ultralytics.h"
#include "extract/import/parsing/people.h"
#include "tests/support/fuzz.h"

namespace stride::imports {
namespace formats {

/// Of their folder, one file.
const Format ultralytics_labels{
    nullptr, [](std::string_view text, const std::string& file, const ImportOptions& /*options*/) {
      return read_ultralytics_labels(text, file, 0);
    }};

}  // namespace formats

void import(std::string_view content) {
  const ImportOptions options;
  take_person(formats::STRIDE_FUZZED_READER.read(content, "fuzz", options), options, "fuzz");
}

}  // namespace stride::imports

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return stride::read_or_refuse(data, size, stride::imports::import);
}
