#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace stride {

/// The colours of lines in plots that stand for different things, the first for what matters most.
inline constexpr std::array kLineColours{"#1b6ca8", "#d1495b", "#66a182", "#edae49", "#5d3a9b",
                                         "#555555", "#00b4d8", "#8d5524", "#e377c2", "#7cb518"};

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
