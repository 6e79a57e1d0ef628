#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/parallel/ranks.h"
#include "extract/skeleton/movement.h"
#include "train/commands/interrupt.h"
#include "train/ppo/train_run.h"
#include "train/training/checkpoint.h"
#include "train/training/runner_factory.h"

namespace stride {
namespace {

namespace fs = std::filesystem;

/// The command line's options.
struct TrainRequest {
  std::string potential, reference, movement, out, resume, preset, config, from;
  std::vector<std::string> assignments;
  std::optional<std::int64_t> seed, decisions;
  bool baseline = false;
};

void apply_overrides(const TrainRequest& request, training::TrainOptions& options) {
  for (const std::string& assignment : request.assignments)
    training::set_option(assignment, options);
  if (request.seed) options.run.seed = *request.seed;
  if (request.decisions) options.run.decisions = *request.decisions;
}

/// Throws Error if the networks of the run in `from` do not fit a run with these options.
void require_fit(const training::TrainOptions& options, const fs::path& from) {
  require(options.run.learner == "ppo", "--from: only ppo can begin with another run's networks");
  const training::TrainOptions other = training::load_run_options(from);
  require(other.run.learner == "ppo", "--from {}: is a run of {}, one of ppo is needed",
          from.string(), other.run.learner);
  require(other.observation == options.observation && other.ppo.mirror == options.ppo.mirror,
          "--from {}: its agent observes otherwise: give both runs the same settings of "
          "[observation] and ppo.mirror",
          from.string());
  require(fs::exists(training::checkpoint_file(from)), "--from {}: has no checkpoint yet",
          from.string());
}

/// A new run: the preset, the movement of the potential, then the config file, then the command
/// line. Returns its folder.
fs::path begin(const TrainRequest& request) {
  require(!request.out.empty(), "--out: name the folder of the run");
  require(request.potential.empty() != !request.baseline,
          "give either --potential FILE, or --baseline to train without one");
  training::TrainOptions options;
  training::read_preset(request.preset, options);
  task::TaskOptions& task = options.environment.task;
  if (!request.potential.empty())
    task = task::task_of(load_potential(request.potential).movement, request.potential);
  if (!request.config.empty()) training::read_toml(request.config, options);
  if (!request.movement.empty()) task = task::task_of(request.movement, "--movement");
  apply_overrides(request, options);
  if (!request.potential.empty())
    options.shaping.source = fs::absolute(request.potential).lexically_normal().string();
  const training::Demonstration demonstration =
      training::load_demonstration(request.potential, request.reference, options.environment);
  if (demonstration.potential)
    fmt::print(stderr, "{}: {}\n", request.potential, demonstration.potential->verdict);
  if (!options.environment.model.empty())
    options.environment.model = fs::absolute(options.environment.model).string();
  if (!request.from.empty()) {
    require_fit(options, request.from);
    options.ppo.start = "start.safetensors";
  }
  training::make_run_folder(options, demonstration, request.out);
  if (!request.from.empty())
    fs::copy_file(training::checkpoint_file(request.from),
                  fs::path(request.out) / options.ppo.start);
  return request.out;
}

/// An existing run; only its length may be changed.
fs::path resume(const TrainRequest& request) {
  require(request.out.empty() && request.potential.empty() && request.reference.empty() &&
              request.movement.empty() && !request.baseline && request.config.empty() &&
              request.from.empty() && request.assignments.empty() && !request.seed,
          "--resume {}: a run keeps its configuration; only --decisions may be given with it",
          request.resume);
  fs::path run = request.resume;
  training::TrainOptions options = training::load_run_options(run);
  if (request.decisions && *request.decisions != options.run.decisions) {
    options.run.decisions = *request.decisions;
    training::write_run_options(options, run);
  }
  return run;
}

void train_as_requested(const TrainRequest& request) {
  parallel::Ranks& ranks = parallel::Ranks::world();
  fs::path run = request.resume.empty() ? request.out : request.resume;
  if (ranks.first()) run = request.resume.empty() ? begin(request) : resume(request);
  ranks.wait_for_all();  // for the folder
  const std::atomic<bool>& interrupted = stopped_by({SIGINT, SIGTERM});
  const training::TrainOptions options = training::load_run_options(run);
  const training::EnvironmentFactory runners =
      training::make_runners(options.environment, training::load_run_demonstration(options, run));
  const training::TrainSummary summary = train_run(run, runners, interrupted, stderr, ranks);
  require(summary.divergence.empty(), "{}: {}; the last good checkpoint is kept", run.string(),
          summary.divergence);
  require(summary.unsaved.empty(),
          "{}: {}; make room, then continue from the checkpoint before: stride train --resume {}",
          run.string(), summary.unsaved, run.string());
  if (!ranks.first()) return;
  if (!summary.finished)
    fmt::print(stderr, "\nstopped and saved; continue with: stride train --resume {}\n",
               run.string());
  fmt::print("{}\n{}\n", summary.brief_report(), run.string());
}

}  // namespace

void add_train_command(CLI::App& app) {
  auto* command = app.add_subcommand("train", "Train a runner, shaped by a potential file");
  const auto request = std::make_shared<TrainRequest>();
  command->add_option("--potential", request->potential, "NAME.potential.json to shape by");
  command->add_option("--reference", request->reference,
                      "Run on which episodes may start; NAME.calibrated.csv beside the potential "
                      "if not given");
  command->add_option("--movement", request->movement,
                      "Whose task the agent learns: run, walk, jump or another of movements.toml; "
                      "that of the potential if not given");
  command->add_flag("--baseline", request->baseline, "Train without a potential");
  command->add_option("--out", request->out, "Folder of the run, new");
  command->add_option("--seed", request->seed, "Of every random number");
  command->add_option("--decisions", request->decisions, "The run ends after so many");
  command
      ->add_option(
          "--preset", request->preset,
          "Settings in train/presets: stride, demo, ppo, competition, ddpg, shaping, paper")
      ->default_val("stride");
  command->add_option("--config", request->config, "TOML file of settings, over the preset");
  command->add_option("--set", request->assignments, "One setting, as agent.gamma=0.99");
  command->add_option("--from", request->from,
                      "Run of ppo whose networks the new run begins with: learning by stages");
  command->add_option("--resume", request->resume, "Continue the run in this folder");
  command->callback([request] { train_as_requested(*request); });
}

}  // namespace stride
