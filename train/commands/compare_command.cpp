#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "train/experiments/compare.h"

namespace stride {

void add_compare_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "compare", "Distances of the seeds of an arm, or their ratio to a control, as a table");
  const auto options = std::make_shared<experiments::CompareOptions>();
  command
      ->add_option("arms", options->arms,
                   "Folders with a run for each seed; several are pooled over their experiments")
      ->required();
  command->add_option("--to", options->controls, "The control of each arm, in the same order");
  command->add_option("--against", options->against, "decisions, simulated (s), or wall (clock, s)")
      ->capture_default_str();
  command->add_option("--at", options->at, "Where on that axis, separated by commas")
      ->delimiter(',')
      ->required();
  command
      ->add_option("--window", options->window,
                   "Evaluations so far before it are averaged; 40000 decisions if not given")
      ->check(CLI::PositiveNumber);
  command->callback([options] { fmt::print("{}", experiments::compare(*options)); });
}

}  // namespace stride
