#pragma once

#include <string_view>

namespace stride {

/// A cell or line without surrounding blanks, tabs and carriage returns.
inline std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace stride
