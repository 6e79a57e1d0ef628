#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stride {

/// A file or folder that comes with the program (model, presets, agents, clips), by its path in
/// the source tree: data_file("train/presets"). It is looked for
///
///   1. in the folder that the environment variable STRIDE_DATA names, if it is set, and there
///   only;
///   2. in ../share/stride from the program, ../../../../share/stride from the Python module;
///   3. in the source tree that the program was built from.
///
/// Throws Error naming those folders where none has it.
std::filesystem::path data_file(const std::filesystem::path& path);

/// Those folders, in this order.
std::vector<std::filesystem::path> data_folders();

/// Version and commit: "0.1.0 (a8a7e8a)".
std::string version();

}  // namespace stride
