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

/// Leaves a vector of that size as it is.
Mirror no_mirror(std::size_t size);

/// Makes right and left one to an agent: it sees every state so that its right leg is ahead, which
/// is to say the mirror image of a state whose left hip is flexed further, and what it then does is
/// mirrored back. Such an agent is symmetric, whatever its network is.
struct RightLegAhead {
  Mirror features, actions;
  int hip_r = 0, hip_l = 0;  // among the features, not normalised

  template <typename Features>
  bool mirrors(const Features& seen) const {
    return seen[hip_l] > seen[hip_r];
  }
};

/// Throws Error if hip_flexion_r is not among the features.
RightLegAhead right_leg_ahead(const std::vector<std::string>& features,
                              const std::vector<std::string>& actions);

}  // namespace stride::environment
