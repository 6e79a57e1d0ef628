#include "extract/io/outputs.h"

#include "extract/io/error.h"

namespace stride {
namespace fs = std::filesystem;
namespace {

/// The same place, whether or not there is a file yet.
bool is_same(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  return fs::weakly_canonical(fs::absolute(a), error) ==
         fs::weakly_canonical(fs::absolute(b), error);
}

bool is_regular(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error);
}

/// Whether the output would replace the input, or a file in it.
bool replaces(const fs::path& output, const fs::path& input) {
  std::error_code error;
  if (is_same(output, input)) return true;
  return fs::is_directory(input, error) && is_regular(output) &&
         is_same(fs::absolute(output).parent_path(), input);
}

}  // namespace

void check_outputs(const std::vector<fs::path>& inputs, const std::vector<Output>& outputs) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    if (output->file.empty()) continue;
    for (const fs::path& input : inputs)
      require(input.empty() || !replaces(output->file, input),
              "{} {}: is an input too and would be overwritten; choose another name",
              output->option, output->file.string());
    for (auto other = outputs.begin(); other != output; ++other)
      require(other->file.empty() || !is_same(output->file, other->file),
              "{} {} and {}: are one file: choose another name", output->option,
              output->file.string(), other->option);
    require(output->kind == FileKind::missing || !fs::is_directory(output->file),
            "{} {}: is a folder: name a file in it", output->option, output->file.string());
    const FileKind there = kind_of(output->file);
    require(output->kind == FileKind::missing || there == FileKind::missing ||
                there == FileKind::empty || there == output->kind,
            "{} {}: there is {} of that name, and {} would replace it; choose another name, or "
            "remove it first",
            output->option, output->file.string(), name(there), name(output->kind));
  }
}

}  // namespace stride
