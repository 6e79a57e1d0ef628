#pragma once

#include <CLI/CLI.hpp>
#include <charconv>

namespace stride {

/// A check of an option of the command line: a finite number in [low, high]. The message names the
/// option (CLI11 does), the value and the rule.
inline CLI::Validator in_range(double low, double high) {
  return CLI::Validator(
      [low, high](std::string& text) -> std::string {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc() && end == text.data() + text.size() && value >= low &&
            value <= high)
          return {};
        return fmt::format("{}: must be a number in [{}, {}]", text, low, high);
      },
      "", "");
}

}  // namespace stride
