#include "train/environment/mirror.h"

#include <algorithm>

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

}  // namespace stride::environment
