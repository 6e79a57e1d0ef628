#include "train/commands.h"

#include <CLI/CLI.hpp>

namespace stride {

void add_train_commands(CLI::App&) {}

}  // namespace stride
