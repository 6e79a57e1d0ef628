#include "extract/import/parsing/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

#include "extract/io/error.h"
#include "extract/io/trimmed.h"

namespace stride::imports {
namespace {

/// Takes the first cell off `line`.
std::string take_cell(std::string_view& line, char separator, bool& more) {
  std::string cell;
  // White space before a quote goes, but not a tab that ends an empty cell.
  const auto start = line.find_first_not_of(separator == '\t' ? " " : " \t");
  if (start != std::string_view::npos && line[start] == '"') {
    line.remove_prefix(start + 1);
    while (!line.empty()) {
      const char c = line.front();
      line.remove_prefix(1);
      if (c != '"') {
        cell += c;
      } else if (!line.empty() && line.front() == '"') {
        cell += '"';
        line.remove_prefix(1);
      } else {
        break;
      }
    }
  }
  const auto end = line.find(separator);
  cell += trimmed(line.substr(0, end));
  more = end != std::string_view::npos;
  line.remove_prefix(more ? end + 1 : line.size());
  return cell;
}

}  // namespace

std::vector<TextLine> split_lines(std::string_view content, char separator) {
  if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
  std::vector<TextLine> lines;
  int number = 0;
  while (!content.empty()) {
    const auto newline = content.find('\n');
    std::string_view line = content.substr(0, newline);
    content.remove_prefix(newline == std::string_view::npos ? content.size() : newline + 1);
    ++number;
    if (trimmed(line).empty()) continue;
    TextLine& split = lines.emplace_back(TextLine{number, {}});
    for (bool more = true; more;) split.cells.push_back(take_cell(line, separator, more));
  }
  return lines;
}

std::optional<double> cell_number(std::string_view cell, char decimal_sign) {
  std::string text(trimmed(cell));
  std::ranges::replace(text, decimal_sign, '.');
  if (text.starts_with('+')) text.erase(0, 1);
  double value = std::numeric_limits<double>::quiet_NaN();
  if (text.empty()) return value;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || std::isinf(value))
    return std::nullopt;
  return value;
}

double number_in(const TextLine& line, std::size_t column, const std::string& file,
                 char decimal_sign) {
  require(column < line.cells.size(), "{}:{}: expected at least {} cells, found {}", file,
          line.number, column + 1, line.cells.size());
  const auto value = cell_number(line.cells[column], decimal_sign);
  require(value.has_value(), "{}:{}: column {} = '{}': expected a number or an empty cell", file,
          line.number, column + 1, line.cells[column]);
  return *value;
}

int frame_in(const TextLine& line, std::size_t column, const std::string& file) {
  const double value = number_in(line, column, file);
  require(value >= 0 && value <= 1e9 && value == std::floor(value),
          "{}:{}: column {} = '{}': expected the number of a frame", file, line.number, column + 1,
          line.cells[column]);
  return static_cast<int>(value);
}

std::optional<int> last_number(std::string_view text) {
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto last = std::find_if(text.rbegin(), text.rend(), is_digit);
  const auto first = std::find_if_not(last, text.rend(), is_digit);
  int value = 0;
  const std::string digits(first.base(), last.base());
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || error != std::errc()) return std::nullopt;
  return value;
}

}  // namespace stride::imports
