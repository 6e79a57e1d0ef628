#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "extract/io/file_kind.h"

namespace stride {

/// A file that a command is about to write.
struct Output {
  std::string option;  // that named it, for the error message: "--overlay", "-o"
  std::filesystem::path file;
  FileKind kind;  // that is written; FileKind::missing: whatever `file` is
};

/// To be called before a command does anything: nothing that a user has may be lost. Throws Error
/// if an output is one of the inputs (by whatever name), lies in the way of another output, or
/// would replace an existing file that is not of its kind. Empty paths are left out; an input may
/// be a folder, whose files are then inputs.
void check_outputs(const std::vector<std::filesystem::path>& inputs,
                   const std::vector<Output>& outputs);

}  // namespace stride
