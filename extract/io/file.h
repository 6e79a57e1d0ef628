#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace stride {

/// The whole file. Throws Error naming the file if it cannot be read.
std::string read_file(const std::filesystem::path& file);

/// Replaces `file` by `content` so that a reader, or a crash at any moment, sees the old file or
/// the new one whole: written beside it, flushed to disk, renamed over it. Throws Error naming the
/// file and the reason.
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

/// SHA-256 of a file's bytes in lower-case hexadecimal: how our files name the video they belong
/// to.
std::string sha256_of_file(const std::filesystem::path& file);
/// The same of bytes in memory.
std::string sha256_of(std::string_view content);

}  // namespace stride
