#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <memory>
#include <optional>

#include "extract/error.h"
#include "train/experiment.h"

namespace stride {
namespace {

std::atomic<bool> interrupted = false;

struct Request {
  std::string name, preset = "shaping";
  std::vector<std::string> assignments;
  std::optional<std::int64_t> decisions;
  ExperimentOptions options;
};

/// The command that repeats it.
std::string command_of(const Request& request) {
  const ExperimentOptions& options = request.options;
  std::string command = fmt::format("stride experiment {} --potential {}", request.name,
                                    options.potential.filename().string());
  if (!options.weak.empty()) command += fmt::format(" --weak {}", options.weak.filename().string());
  command += fmt::format(" --preset {} --seeds {} --decisions {}", request.preset, options.seeds,
                         options.train.run.decisions);
  for (const std::string& assignment : request.assignments)
    command += fmt::format(" --set {}", assignment);
  return command;
}

void experiment_as_requested(Request& request) {
  require(request.name == "baseline-vs-shaping", "experiment '{}': must be baseline-vs-shaping",
          request.name);
  ExperimentOptions& options = request.options;
  read_toml(preset_file(request.preset), options.train);
  for (const std::string& assignment : request.assignments) set_option(assignment, options.train);
  if (request.decisions) options.train.run.decisions = *request.decisions;
  options.train.check();
  if (options.runs.empty()) options.runs = std::filesystem::path("runs") / request.name;
  if (options.report.empty()) options.report = options.runs / "report";
  options.command = command_of(request);
  std::signal(SIGINT, [](int) { interrupted = true; });
  std::signal(SIGTERM, [](int) { interrupted = true; });
  if (run_experiment(options, interrupted, stderr))
    fmt::print("{}\n", (options.report / "results.md").string());
  else
    fmt::print("stopped and saved; give the same command again to continue\n");
}

}  // namespace

void add_experiment_command(CLI::App& app) {
  auto* command = app.add_subcommand("experiment", "Run an experiment of the paper over seeds");
  const auto request = std::make_shared<Request>();
  ExperimentOptions& options = request->options;
  command->add_option("name", request->name, "baseline-vs-shaping")->required();
  command->add_option("--potential", options.potential, "Of the arm `shaped`")->required();
  command->add_option("--weak", options.weak, "Of a third arm, made of a weak agent's own run");
  command->add_option("--seeds", options.seeds, "1, 2, …")->capture_default_str();
  command->add_option("--decisions", request->decisions, "Of each run");
  command->add_option("--jobs", options.jobs, "Runs side by side")->capture_default_str();
  command->add_option("--preset", request->preset, "Of every run")->capture_default_str();
  command->add_option("--set", request->assignments, "One setting of every run");
  command->add_option("--out", options.runs, "Folder of the runs; runs/<name> if not given");
  command->add_option("--report", options.report,
                      "Folder of curves and figures; OUT/report if not given");
  command->callback([request] { experiment_as_requested(*request); });
}

}  // namespace stride
