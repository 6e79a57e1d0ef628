#pragma once

namespace CLI {
class App;
}

namespace stride {

/// Adds the commands of `shaping/` to the program.
void add_shaping_commands(CLI::App& app);

}  // namespace stride
