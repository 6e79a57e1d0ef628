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
  command->add_option("--at", options->decisions, "Numbers of decisions, separated by commas")
      ->delimiter(',')
      ->required();
  command
      ->add_option("--window", options->window,
                   "Decisions over which evaluations are averaged, up to each number")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->callback([options] { fmt::print("{}", experiments::compare(*options)); });
}

}  // namespace stride
