#pragma once

namespace CLI {
class App;
}

namespace stride {

/// Adds the commands of `shaping/` to the program.
void add_shaping_commands(CLI::App& app);

void add_convert_command(CLI::App& app);
void add_info_command(CLI::App& app);

}  // namespace stride
