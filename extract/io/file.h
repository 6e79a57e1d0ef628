#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
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

/// A JSON document as our files hold it: indented, with a last newline. Bytes of names that are not
/// UTF-8 become U+FFFD.
std::string json_text(const nlohmann::ordered_json& json);
/// The document that `content` of `file` holds. Throws Error with file, line and column, and what
/// was `expected`: "a potential; make one with `stride convert`".
nlohmann::ordered_json parse_json(std::string_view content, const std::filesystem::path& file,
                                  std::string_view expected);

}  // namespace stride
