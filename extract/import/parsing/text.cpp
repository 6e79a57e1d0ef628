#include "extract/import/parsing/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "extract/io/error.h"

namespace stride::imports {

double number_in(const TextLine& line, std::size_t column, const std::string& file) {
  require(column < line.cells.size(), "{}:{}: expected at least {} cells, found {}", file,
          line.number, column + 1, line.cells.size());
  const auto value = cell_number(line.cells[column]);
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
