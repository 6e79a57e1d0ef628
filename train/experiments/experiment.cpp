#include "train/experiments/experiment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "calibrate/runner/calibrated.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/parallel/ranks.h"
#include "train/evaluation/evaluate.h"
#include "train/experiments/experiment_report.h"
#include "train/ppo/train_run.h"
#include "train/task/task.h"
#include "train/training/runner_factory.h"
#include "train/training/thread_pool.h"

namespace stride::experiments {
namespace fs = std::filesystem;
namespace {

struct Job {
  const ExperimentArm* arm = nullptr;
  int seed = 0;
  fs::path run;
  bool elsewhere = false;  // another experiment has its curve
};

/// Paired seeds next to each other, so that an unfinished experiment can be compared.
std::vector<Job> jobs_of(const ExperimentOptions& options) {
  std::vector<Job> jobs;
  const int first = options.experiment.first_seed;
  for (int seed = first; seed < first + options.experiment.seeds; ++seed)
    for (const ExperimentArm& arm : options.experiment.arms) {
      const fs::path other = arm.curves / std::to_string(seed);
      const bool elsewhere = !arm.curves.empty() && fs::exists(other / "curve.csv");
      jobs.push_back({&arm, seed,
                      elsewhere ? other : options.runs / arm.name / std::to_string(seed),
                      elsewhere});
    }
  return jobs;
}

bool is_finished(const Job& job) { return job.elsewhere || fs::exists(job.run / "finished"); }

std::string name_of(const Job& job) { return fmt::format("{}/{}", job.arm->name, job.seed); }

/// Those that were asked for.
void keep_only(const std::vector<std::string>& names, std::vector<Job>& jobs) {
  std::vector<std::string> known;
  for (const Job& job : jobs) known.push_back(name_of(job));
  for (const std::string& name : names)
    require(std::ranges::find(known, name) != known.end(), "--only {}: must be one of {}", name,
            fmt::join(known, ", "));
  std::erase_if(
      jobs, [&](const Job& job) { return std::ranges::find(names, name_of(job)) == names.end(); });
}

/// The seeds that are finished in every arm, since arms are compared seed by seed.
void keep_finished(std::FILE* messages, std::vector<Job>& jobs) {
  std::set<int> missing;
  for (const Job& job : jobs)
    if (!is_finished(job)) {
      fmt::print(messages, "{}: is not finished; seed {} is left out\n", name_of(job), job.seed);
      missing.insert(job.seed);
    }
  std::erase_if(jobs, [&](const Job& job) { return missing.contains(job.seed); });
  require(!jobs.empty(), "no seed is finished in every arm: there is nothing to report yet");
}

/// Makes the run folder. One that is there must be of the same run.
void begin(const Job& job) {
  if (job.elsewhere) return;
  const fs::path& potential = job.arm->potential;
  training::TrainOptions options = job.arm->train;
  options.run.seed = job.seed;
  options.run.threads = 1;
  if (!potential.empty()) options.shaping.source = potential.filename().string();
  const training::Demonstration demonstration =
      training::load_demonstration(potential, {}, options.environment);
  const bool begun = fs::exists(job.run / "config.toml");
  (begun ? training::require_same_run : training::make_run_folder)(options, demonstration, job.run);
}

/// What the runs read at their beginning and end is there and can be read.
void require_files(const ExperimentFile& experiment) {
  for (const ExperimentArm& arm : experiment.arms)
    training::load_demonstration(arm.potential, {}, arm.train.environment);
  if (!experiment.clip.empty()) load_calibrated(experiment.clip);
}

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Trains to the end or until stopped, then evaluates the last agent. The replay memory of a
/// finished run is removed.
std::string work_on(const Job& job, const fs::path& clip, const std::atomic<bool>& stop) {
  const training::TrainOptions options = training::load_run_options(job.run);
  const std::unique_ptr<std::FILE, FileCloser> log(std::fopen((job.run / "log.txt").c_str(), "a"));
  const training::TrainSummary summary =
      train_run(job.run,
                training::make_runners(options.environment,
                                       training::load_run_demonstration(options, job.run)),
                stop, log.get());
  if (!summary.divergence.empty()) return summary.divergence;
  if (!summary.unsaved.empty()) return summary.unsaved;
  if (!summary.finished) return "stopped";
  evaluation::EvaluateOptions last;
  last.threads = 1;
  last.agent = "agent";
  last.film = false;
  last.clip = clip;
  evaluation::evaluate(job.run, last);
  write_file_atomically(job.run / "finished", "");
  fs::remove_all(job.run / "replay");
  return summary.brief_report();
}

/// Copies configuration, curves and evaluation of each run.
void copy_runs(const std::vector<Job>& jobs, const fs::path& report) {
  for (const Job& job : jobs) {
    if (job.elsewhere) continue;
    const fs::path to = report / job.arm->name / std::to_string(job.seed);
    for (const char* name : {"config.toml", "curve.csv", "timing.csv", "evaluation.json"})
      if (fs::exists(job.run / name)) write_file_atomically(to / name, read_file(job.run / name));
  }
}

/// The runs of each arm of the experiment.
std::vector<Arm> arms_of(const std::vector<Job>& jobs, const ExperimentFile& experiment) {
  std::vector<Arm> arms;
  for (const ExperimentArm& arm : experiment.arms) {
    arms.push_back({.label = arm.name, .runs = {}, .decisions = arm.train.run.decisions});
    for (const Job& job : jobs)
      if (job.arm->name == arm.name) arms.back().runs.push_back(job.run);
  }
  return arms;
}

void write_report(const std::vector<Job>& jobs, const ExperimentOptions& options) {
  copy_runs(jobs, options.report);
  const ExperimentFile& experiment = options.experiment;
  const std::vector<Arm> arms = arms_of(jobs, experiment);
  write_file_atomically(options.report / "results.md",
                        experiment_report(experiment,
                                          results_of(arms, experiment.decisions,
                                                     task::milestone_m(experiment.task().name)),
                                          options.command));
  for (const std::string& against : {experiment.against(), std::string("wall")})
    plot(arms, {.against = against, .level = experiment.level, .out = options.report / against});
}

}  // namespace

std::vector<std::string> run_names(const ExperimentFile& experiment) {
  require_files(experiment);
  ExperimentOptions options;
  options.experiment = experiment;
  std::vector<std::string> names;
  for (const Job& job : jobs_of(options)) names.push_back(name_of(job));
  return names;
}

std::string verdict_row(const fs::path& file) {
  const ExperimentFile experiment = load_experiment(file);
  const ExperimentClaim& claim = experiment.claim;
  std::string row =
      fmt::format("| {} | {} | {} / {} |", absolute(file).parent_path().filename().string(),
                  claim.text, claim.better, claim.than);
  ExperimentOptions kept;
  kept.experiment = experiment;
  kept.runs = absolute(file).parent_path();
  std::vector<Job> jobs = jobs_of(kept);
  std::set<int> missing;  // seeds that an arm does not have
  for (const Job& job : jobs)
    if (!fs::exists(job.run / "curve.csv")) missing.insert(job.seed);
  std::erase_if(jobs, [&](const Job& job) { return missing.contains(job.seed); });
  if (jobs.empty()) return row + " 0 | | | not run yet |\n";
  const std::vector<Arm> arms = arms_of(jobs, experiment);
  const Verdict verdict = verdict_on(claim, results_of(arms, experiment.decisions));
  if (!std::isfinite(verdict.ratio.ratio) && std::isfinite(verdict.difference.low_m))
    return row + fmt::format(" {} | {} m more | | {} |\n", verdict.pairs,
                             difference_text(verdict.difference, 2), verdict.word);
  if (!std::isfinite(verdict.ratio.ratio))
    return row + fmt::format(" {} | too few seeds | | {} |\n", verdict.pairs, verdict.word);
  return row + fmt::format(" {} | {} | {:.2f} … {:.2f} | {} |\n", verdict.pairs,
                           ratio_text(verdict.ratio), verdict.ratio.bootstrap_low,
                           verdict.ratio.bootstrap_high, verdict.word);
}

bool run_experiment(const ExperimentOptions& options, const std::atomic<bool>& stop,
                    std::FILE* messages) {
  require_files(options.experiment);
  parallel::Ranks& ranks = parallel::Ranks::world();
  std::vector<Job> all = jobs_of(options);
  if (options.merge) {
    if (!ranks.first()) return true;
    keep_finished(messages, all);
    for (const Job& job : all) begin(job);
    write_report(all, options);
    return true;
  }
  if (!options.only.empty()) keep_only(options.only, all);
  std::vector<Job> jobs;  // of this rank
  for (std::size_t i = 0; i < all.size(); ++i)
    if (ranks.owns(static_cast<int>(i))) jobs.push_back(all[i]);
  for (const Job& job : jobs) begin(job);
  training::ThreadPool pool(options.jobs);
  pool.run(static_cast<int>(jobs.size()), [&](int i) {
    const Job& job = jobs[static_cast<std::size_t>(i)];
    if (stop || is_finished(job)) return;
    fmt::print(messages, "{} seed {}: begins\n", job.arm->name, job.seed);
    const std::string outcome = work_on(job, options.experiment.clip, stop);
    fmt::print(messages, "{} seed {}: {}\n", job.arm->name, job.seed, outcome);
    std::fflush(messages);
  });
  bool stopped = false;
  for (const std::string& each : ranks.gather(stop ? "stopped" : "")) stopped |= !each.empty();
  if (stopped) return false;
  if (ranks.first() && options.only.empty()) write_report(all, options);
  ranks.wait_for_all();
  return true;
}

}  // namespace stride::experiments
