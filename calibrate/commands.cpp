#include "calibrate/commands.h"

#include <CLI/CLI.hpp>

namespace stride {

void add_calibrate_commands(CLI::App&) {}

}  // namespace stride
