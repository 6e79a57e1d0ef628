#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace stride {

/// A text as a string constant of a gnuplot script. Gnuplot runs backquotes, follows escapes and
/// replaces macros in double quotes and nothing in single ones, so that names and titles that come
/// from outside go through here and nowhere else. Control characters become blanks.
std::string gnuplot_string(std::string_view text);

/// The same for the name of a file in gnuplot's working folder: gnuplot takes a name that begins
/// with `|` or `<` for a command.
std::string gnuplot_file(std::string_view name);

/// Runs gnuplot on a script, in `folder` if one is given, and returns what it prints. Throws Error
/// naming the package if it cannot be run, and with its last complaint if it fails.
std::string run_gnuplot(const std::string& script, const std::filesystem::path& folder = {});

}  // namespace stride
