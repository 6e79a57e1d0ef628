#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stride::imports {

struct TextLine {
  int number = 0;  // from 1
  std::vector<std::string> cells;
};

/// Lines of a text cut at `separator`, quotes as in RFC 4180 (but no line breaks inside them) taken
/// off. Blank lines are left out; white space around a cell too.
std::vector<TextLine> split_lines(std::string_view content, char separator);

/// A finite number, or NaN for an empty cell or "nan"; nothing for anything else.
std::optional<double> cell_number(std::string_view cell, char decimal_sign = '.');

/// The same; throws Error "file:line: column C = 'cell': expected a number or an empty cell".
double number_in(const TextLine& line, std::size_t column, const std::string& file,
                 char decimal_sign = '.');

/// A whole number that counts frames, ≥ 0. Throws Error likewise.
int frame_in(const TextLine& line, std::size_t column, const std::string& file);

/// The last run of digits of a text, as in "img0012.png"; nothing without one.
std::optional<int> last_number(std::string_view text);

}  // namespace stride::imports
