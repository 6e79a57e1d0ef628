#pragma once

namespace CLI {
class App;
}

namespace stride {

/// Adds the commands of `extract/` to the program.
void add_extract_commands(CLI::App& app);

}  // namespace stride
