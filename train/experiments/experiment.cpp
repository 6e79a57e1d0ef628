#include "train/experiments/experiment.h"

#include <fmt/format.h>

#include <memory>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "train/experiments/experiment_report.h"
#include "train/training/runner_factory.h"
#include "train/training/thread_pool.h"
#include "train/training/train.h"

namespace stride::experiments {
namespace fs = std::filesystem;
namespace {

struct Job {
  const ExperimentArm* arm = nullptr;
  int seed = 0;
  fs::path run;
};

/// Paired seeds next to each other, so that an unfinished experiment can be compared.
std::vector<Job> jobs_of(const ExperimentOptions& options) {
  std::vector<Job> jobs;
  for (int seed = 1; seed <= options.experiment.seeds; ++seed)
    for (const ExperimentArm& arm : options.experiment.arms)
      jobs.push_back({&arm, seed, options.runs / arm.name / std::to_string(seed)});
  return jobs;
}

void begin(const Job& job) {
  if (fs::exists(job.run / "config.toml")) return;
  const fs::path& potential = job.arm->potential;
  training::TrainOptions options = job.arm->train;
  options.run.seed = job.seed;
  options.run.threads = 1;
  if (!potential.empty()) options.shaping.source = potential.filename().string();
  training::make_run_folder(
      options, training::load_demonstration(potential, {}, options.environment), job.run);
}

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Trains to the end or until stopped. The replay memory of a finished run is removed.
std::string work_on(const Job& job, const std::atomic<bool>& stop) {
  const training::TrainOptions options = training::load_run_options(job.run);
  const std::unique_ptr<std::FILE, FileCloser> log(std::fopen((job.run / "log.txt").c_str(), "a"));
  const training::TrainSummary summary =
      training::train(job.run,
                      training::make_runners(options.environment,
                                             training::load_run_demonstration(options, job.run)),
                      stop, log.get());
  if (!summary.divergence.empty()) return summary.divergence;
  if (!summary.unsaved.empty()) return summary.unsaved;
  if (!summary.finished) return "stopped";
  write_file_atomically(job.run / "finished", "");
  fs::remove_all(job.run / "replay");
  return summary.brief_report();
}

/// Copies configuration and curves of each run.
void copy_runs(const std::vector<Job>& jobs, const fs::path& report) {
  for (const Job& job : jobs) {
    const fs::path to = report / job.arm->name / std::to_string(job.seed);
    for (const char* name : {"config.toml", "curve.csv", "timing.csv"})
      write_file_atomically(to / name, read_file(job.run / name));
  }
}

}  // namespace

bool run_experiment(const ExperimentOptions& options, const std::atomic<bool>& stop,
                    std::FILE* messages) {
  const std::vector<Job> jobs = jobs_of(options);
  for (const Job& job : jobs) begin(job);
  training::ThreadPool pool(options.jobs);
  pool.run(static_cast<int>(jobs.size()), [&](int i) {
    const Job& job = jobs[static_cast<std::size_t>(i)];
    if (stop || fs::exists(job.run / "finished")) return;
    fmt::print(messages, "{} seed {}: begins\n", job.arm->name, job.seed);
    const std::string outcome = work_on(job, stop);
    fmt::print(messages, "{} seed {}: {}\n", job.arm->name, job.seed, outcome);
    std::fflush(messages);
  });
  if (stop) return false;

  std::vector<fs::path> runs;
  for (const Job& job : jobs) runs.push_back(job.run);
  const std::vector<Arm> arms = arms_of(runs);
  copy_runs(jobs, options.report);
  const ExperimentFile& experiment = options.experiment;
  write_file_atomically(options.report / "results.md",
                        experiment_report(experiment.title, results_of(arms, experiment.decisions),
                                          experiment.decisions, options.command));
  for (const char* against : {"decisions", "wall"})
    plot(arms, {.against = against, .out = options.report / against});
  return true;
}

}  // namespace stride::experiments
