#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace stride {

/// An error that the user can fix. The message names the thing, the value, the rule and the cure:
/// `ddpg.gamma = 1.2: must be in [0, 1)`. Thrown at the edges (files, options, data of others),
/// caught in main().
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws Error with the formatted message unless `condition` holds.
template <typename... Args>
void require(bool condition, fmt::format_string<Args...> message, Args&&... args) {
  if (!condition) throw Error(fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace stride
