#include "extract/commands.h"

#include <CLI/CLI.hpp>

namespace stride {

void add_extract_commands(CLI::App&) {}

}  // namespace stride
