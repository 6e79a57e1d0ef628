#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "extract/io/csv.h"

namespace stride::imports {

/// As cell_number(); throws Error "file:line: column C = 'cell': expected a number or an empty
/// cell".
double number_in(const TextLine& line, std::size_t column, const std::string& file);

/// A whole number that counts frames, ≥ 0. Throws Error likewise.
int frame_in(const TextLine& line, std::size_t column, const std::string& file);

/// The last run of digits of a text, as in "img0012.png"; nothing without one.
std::optional<int> last_number(std::string_view text);

}  // namespace stride::imports
