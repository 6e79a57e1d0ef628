#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace stride {

/// The whole file. Throws Error naming the file if it cannot be read.
std::string read_file(const std::filesystem::path& file);

/// Replaces `file` atomically: writes beside it, flushes to disk, renames. Throws Error with the
/// file and the reason.
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

/// SHA-256 of a file in lower-case hexadecimal; our files identify their video by it.
std::string sha256_of_file(const std::filesystem::path& file);
/// The same of bytes in memory.
std::string sha256_of(std::string_view content);

std::string base64_of(std::string_view content);

}  // namespace stride
