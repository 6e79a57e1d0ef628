#include "shaping/commands.h"

#include <CLI/CLI.hpp>

namespace stride {

void add_shaping_commands(CLI::App&) {}

}  // namespace stride
