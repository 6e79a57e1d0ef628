// The program `stride`: its commands, in the order of the pipeline.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "calibrate/commands.h"
#include "extract/commands.h"
#include "extract/io/data_file.h"
#include "extract/parallel/ranks.h"
#include "packaging/manual.h"
#include "shaping/commands.h"
#include "train/commands.h"

int main(int argc, char** argv) {
  CLI::App app{"Stride: from a running video to a muscle-driven runner"};
  app.require_subcommand(1);
  app.set_version_flag("--version", stride::version());
  try {
    stride::add_extract_commands(app);
    stride::add_calibrate_commands(app);
    stride::add_shaping_commands(app);
    stride::add_train_commands(app);
    stride::packaging::add_packaging_commands(app, stride::version());
    stride::parallel::Ranks& ranks = stride::parallel::Ranks::world();
    app.parse(argc, argv);
    ranks.finish();
    return 0;
  } catch (const CLI::ParseError& e) {
    return app.exit(e);
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 1;
  }
}
