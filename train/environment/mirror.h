#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stride::environment {

/// Reflection of a vector of named quantities in the sagittal plane, an involution: mirrored[i] =
/// sign[i] · x[source[i]].
struct Mirror {
  std::vector<int> source;
  std::vector<double> sign;
  std::vector<int> negated;  // where sign is −1

  /// For contiguous columns and vectors; not in place.
  template <typename In, typename Out>
  void apply(const In& x, Out&& mirrored) const {
    const auto* from = x.data();
    auto* to = mirrored.data();
    for (std::size_t i = 0, n = source.size(); i < n; ++i) to[i] = from[source[i]];
    for (const int i : negated) to[i] = -to[i];
  }
};

/// `knee_angle_r` ↔ `knee_angle_l`, `talus_r_vx` ↔ `talus_l_vx`: the parts `r` and `l` of the name,
/// between underscores, are exchanged.
std::string mirrored_name(std::string_view name);

/// Swaps right and left; changes the sign of `phase_sin` and `phase_cos` (half a stride later) and
/// leaves the rest. Throws Error naming a quantity whose other side is missing.
Mirror mirror_by_name(const std::vector<std::string>& names);

}  // namespace stride::environment
