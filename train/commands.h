#pragma once

namespace CLI {
class App;
}

namespace stride {

/// Adds the commands of `train/` to the program.
void add_train_commands(CLI::App& app);

}  // namespace stride
