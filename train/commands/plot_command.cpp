#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "train/commands/interrupt.h"
#include "train/experiments/plot.h"

namespace stride {

void add_plot_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "plot", "Learning curves of runs, mean and standard error over seeds: SVG and PNG");
  struct Request {
    std::vector<std::string> runs;
    experiments::PlotOptions options;
    bool watch = false;
  };
  const auto request = std::make_shared<Request>();
  command
      ->add_option("runs", request->runs,
                   "Run folders; those named by a number are seeds of the arm above")
      ->required();
  command->add_option("-o,--out", request->options.out, "OUT.svg, .png, .csv and .gnuplot")
      ->capture_default_str();
  command->add_option("--against", request->options.against, "decisions, simulated or wall")
      ->capture_default_str();
  command->add_option("--column", request->options.column, "Of curve.csv")->capture_default_str();
  command->add_option("--title", request->options.title, "Of the picture");
  command->add_flag("--watch", request->watch, "Draw anew whenever a curve grows, until Ctrl-C");
  command->callback([request] {
    const std::vector<experiments::Arm> arms =
        experiments::arms_of({request->runs.begin(), request->runs.end()});
    if (request->watch)
      return experiments::watch(arms, request->options, training::stopped_by({SIGINT}), stderr);
    experiments::plot(arms, request->options);
    fmt::print("{0}.svg\n{0}.png\n", request->options.out.string());
  });
}

}  // namespace stride
