#include "shaping/commands.h"

namespace stride {

void add_shaping_commands(CLI::App& app) {
  add_convert_command(app);
  add_info_command(app);
}

}  // namespace stride
