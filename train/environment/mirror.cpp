#include "train/environment/mirror.h"

#include <algorithm>
#include <numeric>

#include "extract/io/error.h"

namespace stride::environment {

std::string mirrored_name(std::string_view name) {
  std::string mirrored;
  for (;;) {
    const auto end = name.find('_');
    const std::string_view part = name.substr(0, end);
    mirrored += part == "r" ? "l" : part == "l" ? "r" : part;
    if (end == std::string_view::npos) return mirrored;
    mirrored += '_';
    name.remove_prefix(end + 1);
  }
}

Mirror mirror_by_name(const std::vector<std::string>& names) {
  Mirror mirror;
  for (const std::string& name : names) {
    const std::string other = mirrored_name(name);
    const auto found = std::ranges::find(names, other);
    require(found != names.end(), "{}: its mirror image '{}' is missing", name, other);
    mirror.source.push_back(static_cast<int>(found - names.begin()));
    const bool negated = name == "phase_sin" || name == "phase_cos";
    if (negated) mirror.negated.push_back(static_cast<int>(mirror.sign.size()));
    mirror.sign.push_back(negated ? -1 : 1);
  }
  return mirror;
}

Mirror no_mirror(std::size_t size) {
  Mirror mirror{
      .source = std::vector<int>(size), .sign = std::vector<double>(size, 1), .negated = {}};
  std::iota(mirror.source.begin(), mirror.source.end(), 0);
  return mirror;
}

RightLegAhead right_leg_ahead(const std::vector<std::string>& features,
                              const std::vector<std::string>& actions) {
  RightLegAhead symmetry{.features = mirror_by_name(features), .actions = mirror_by_name(actions)};
  const auto found = std::ranges::find(features, "hip_flexion_r");
  require(found != features.end(),
          "ppo.mirror: needs hip_flexion_r among the features, to tell which leg is ahead");
  symmetry.hip_r = static_cast<int>(found - features.begin());
  symmetry.hip_l = symmetry.features.source[static_cast<std::size_t>(symmetry.hip_r)];
  return symmetry;
}

}  // namespace stride::environment
