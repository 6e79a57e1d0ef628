#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "extract/io/error.h"
#include "extract/io/option_range.h"
#include "extract/parallel/ranks.h"
#include "train/commands/interrupt.h"
#include "train/experiments/experiment.h"

namespace stride {
namespace {

struct ExperimentRequest {
  std::string name, potential;
  std::vector<std::string> settings;
  std::optional<int> seeds;
  std::optional<std::int64_t> decisions;
  bool list = false;
  experiments::ExperimentOptions options;
};

/// The command that repeats it.
std::string command_of(const ExperimentRequest& request) {
  std::string command = fmt::format("stride experiment {}", request.name);
  if (!request.potential.empty()) command += fmt::format(" --potential {}", request.potential);
  if (request.seeds) command += fmt::format(" --seeds {}", *request.seeds);
  if (request.decisions) command += fmt::format(" --decisions {}", *request.decisions);
  for (const std::string& setting : request.settings) command += fmt::format(" --set {}", setting);
  return command;
}

/// Replaces the potential of the first shaped arm by `potential` in all arms that use it; curves
/// that were made with the other are not theirs.
void replace_potential(const std::filesystem::path& potential,
                       std::vector<experiments::ExperimentArm>& arms) {
  const auto shaped = std::ranges::find_if(
      arms, [](const experiments::ExperimentArm& arm) { return !arm.potential.empty(); });
  require(shaped != arms.end(), "--potential {}: no arm has one", potential.string());
  const std::filesystem::path replaced = shaped->potential;
  for (experiments::ExperimentArm& arm : arms) {
    if (arm.potential != replaced) continue;
    fmt::print(stderr, "{}: {} instead of {}\n", arm.name, potential.string(), replaced.string());
    arm.potential = potential;
    arm.curves.clear();
  }
}

void experiment_as_requested(const ExperimentRequest& request);

/// All of a group: what became of their claims, or the experiments one after the other.
void group_as_requested(const std::vector<std::filesystem::path>& group,
                        const ExperimentRequest& request) {
  if (request.list) fmt::print("{}", experiments::kVerdictHeading);
  for (const std::filesystem::path& file : group) {
    if (request.list) {
      fmt::print("{}", experiments::verdict_row(file));
      continue;
    }
    ExperimentRequest one = request;
    one.name = file.string();
    if (!one.options.runs.empty()) one.options.runs /= file.parent_path().filename();
    if (!one.options.report.empty()) one.options.report /= file.parent_path().filename();
    experiment_as_requested(one);
  }
}

void experiment_as_requested(const ExperimentRequest& request) {
  if (const auto group = experiments::experiment_group(request.name); !group.empty())
    return group_as_requested(group, request);
  experiments::ExperimentOptions options = request.options;
  std::vector<std::string> settings = request.settings;
  if (request.decisions) settings.push_back(fmt::format("run.decisions={}", *request.decisions));
  const std::filesystem::path file = experiments::experiment_file(request.name);
  options.experiment = experiments::load_experiment(file, settings);
  if (request.seeds) options.experiment.seeds = *request.seeds;
  if (!request.potential.empty()) replace_potential(request.potential, options.experiment.arms);
  if (request.list) {
    for (const std::string& name : experiments::run_names(options.experiment))
      fmt::print("{}\n", name);
    return;
  }
  require(options.only.empty() || !options.merge, "--only and --merge: give one of them");
  if (options.runs.empty())
    options.runs = std::filesystem::path("runs") / absolute(file).parent_path().filename();
  if (options.report.empty()) options.report = options.runs / "report";
  options.command = command_of(request);
  const bool finished = experiments::run_experiment(options, stopped_by({SIGINT, SIGTERM}), stderr);
  if (!parallel::Ranks::world().first()) return;
  if (!finished)
    fmt::print("stopped and saved; give the same command again to continue\n");
  else if (options.only.empty())
    fmt::print("{}\n", (options.report / "results.md").string());
  else
    fmt::print("{}\n", options.runs.string());
}

}  // namespace

void add_experiment_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "experiment", "Train the arms of an experiment over seeds and compare their curves");
  const auto request = std::make_shared<ExperimentRequest>();
  experiments::ExperimentOptions& options = request->options;
  command
      ->add_option("NAME", request->name,
                   "A folder of train/results, as baseline-vs-shaping or figures/mirrored; an "
                   "experiment.toml or its folder; or figures/all: each of that folder")
      ->required();
  command->add_option("--potential", request->potential,
                      "Instead of the potential of the first shaped arm");
  command
      ->add_option("--seeds", request->seeds,
                   "So many from the file's first, instead of the file's")
      ->check(CLI::PositiveNumber);
  command->add_option("--decisions", request->decisions, "Of each run, instead of the file's");
  command->add_option("--jobs", options.jobs, "Runs side by side")
      ->check(in_range(1, 1024))
      ->capture_default_str();
  command->add_flag("--list", request->list,
                    "Only print the runs, ARM/SEED, a line each; of figures/all the verdicts");
  command->add_option("--only", options.only,
                      "Only these runs, ARM/SEED, without a report: for an array of jobs");
  command->add_flag("--merge", options.merge,
                    "Train nothing: report over the seeds that are finished in every arm");
  command->add_option("--set", request->settings,
                      "One setting of every arm that does not say otherwise");
  command->add_option("--out", options.runs, "Folder of the runs; runs/NAME if not given");
  command->add_option("--report", options.report,
                      "Folder of curves and figures; OUT/report if not given");
  command->callback([request] { experiment_as_requested(*request); });
}

}  // namespace stride
