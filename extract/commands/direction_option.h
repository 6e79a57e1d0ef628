#pragma once

#include <optional>

#include "extract/skeleton/facing.h"

namespace CLI {
class App;
}

namespace stride {

/// Adds `--direction right|left`.
void add_direction_option(CLI::App& command, std::optional<Facing>& direction);

}  // namespace stride
