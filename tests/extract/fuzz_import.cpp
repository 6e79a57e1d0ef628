// A libFuzzer target for each import format: whatever the bytes, a reader imports or throws Error.
//     cmake -B build/fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DSTRIDE_FUZZ=ON
//     cmake --build build/fuzz --target fuzz_import_read_sleap
//     build/fuzz/tests/extract/fuzz_import_read_sleap -max_total_time=600 CORPUS_FOLDER
#include <string_view>

#include "extract/import/formats/formats.h"
#include "extract/import/networks/networks.h"
#include "extract/import/parsing/people.h"
#include "tests/support/fuzz.h"

namespace stride::imports {

ImportedFile openpose(std::string_view content, const std::string& file, const ImportOptions&) {
  return read_openpose(content, file, 0);
}
ImportedFile json(std::string_view content, const std::string& file, const ImportOptions&) {
  return read_own_json(content, file);
}
ImportedFile ultralytics_labels(std::string_view content, const std::string& file,
                                const ImportOptions&) {
  return read_ultralytics_labels(content, file, 0);
}

void import(std::string_view content) {
  const ImportOptions options;
  take_person(STRIDE_FUZZED_READER(content, "fuzz", options), options, "fuzz");
}

}  // namespace stride::imports

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return stride::read_or_refuse(data, size, stride::imports::import);
}
