#include "extract/commands.h"

#include <CLI/CLI.hpp>

namespace stride {

void add_annotate_command(CLI::App& app);
void add_track_command(CLI::App& app);

void add_extract_commands(CLI::App& app) {
  add_annotate_command(app);
  add_track_command(app);
}

}  // namespace stride
