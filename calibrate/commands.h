#pragma once

namespace CLI {
class App;
}

namespace stride {

/// Adds the commands of `calibrate/` to the program.
void add_calibrate_commands(CLI::App& app);

}  // namespace stride
