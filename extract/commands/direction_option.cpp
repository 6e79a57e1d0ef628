#include "extract/commands/direction_option.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace stride {

void add_direction_option(CLI::App& command, std::optional<Facing>& direction) {
  std::vector<std::string> names;
  for (const Named<Facing>& each : kFacings) names.emplace_back(each.name);
  command
      .add_option_function<std::string>(
          "--direction", [&](const std::string& name) { direction = kFacings.find(name); },
          "right or left: the way the runner faces")
      ->check(CLI::IsMember(names));
}

}  // namespace stride
