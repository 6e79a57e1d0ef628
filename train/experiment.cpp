#include "train/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

#include "extract/error.h"
#include "extract/file.h"
#include "extract/table.h"
#include "train/crew.h"
#include "train/runner_factory.h"
#include "train/train.h"

namespace stride {
namespace fs = std::filesystem;
namespace {

struct Job {
  std::string arm;
  int seed = 0;
  fs::path potential;  // empty: none
  fs::path run;
};

/// Paired seeds next to each other, so that what is done at any time can be compared.
std::vector<Job> jobs_of(const ExperimentOptions& options) {
  std::vector<std::pair<std::string, fs::path>> arms{{"baseline", {}},
                                                     {"shaped", options.potential}};
  if (!options.weak.empty()) arms.emplace_back("weak", options.weak);
  std::vector<Job> jobs;
  for (int seed = 1; seed <= options.seeds; ++seed)
    for (const auto& [arm, potential] : arms)
      jobs.push_back({arm, seed, potential, options.runs / arm / std::to_string(seed)});
  return jobs;
}

void begin(const Job& job, const ExperimentOptions& options) {
  if (fs::exists(job.run / "config.toml")) return;
  TrainOptions train_options = options.train;
  train_options.run.seed = job.seed;
  train_options.run.threads = 1;
  std::optional<Potential> potential;
  if (!job.potential.empty()) {
    potential = load_potential(job.potential);
    train_options.shaping.source = job.potential.filename().string();
  }
  make_run_folder(train_options, potential ? &*potential : nullptr, job.run);
}

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Trains to the end or until stopped. The replay memory of a finished run is removed.
std::string work_on(const Job& job, const std::atomic<bool>& stop) {
  const TrainOptions options = load_run_options(job.run);
  const std::optional<Potential> potential = load_run_potential(options, job.run);
  const std::unique_ptr<std::FILE, FileCloser> log(std::fopen((job.run / "log.txt").c_str(), "a"));
  const TrainSummary summary =
      train(job.run, make_runners(options.environment, potential ? &*potential : nullptr), stop,
            log.get());
  if (!summary.divergence.empty()) return summary.divergence;
  if (!summary.finished) return "stopped";
  write_file_atomically(job.run / "finished", "");
  fs::remove_all(job.run / "replay");
  return summary.brief_report();
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standard_deviation(const std::vector<double>& values) {
  const double m = mean(values);
  double squares = 0;
  for (const double v : values) squares += (v - m) * (v - m);
  return std::sqrt(squares / (static_cast<double>(values.size()) - 1));
}

/// Student's t for a two-sided 95 % interval.
double student_95(std::size_t degrees) {
  constexpr std::array kT{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228};
  return degrees <= kT.size() ? kT[degrees - 1] : 1.96;
}

/// Mean of the column's rows with decisions in (from, to].
double mean_between(const Table& curve, double from, double to) {
  const std::size_t x = curve.column("decisions"), y = curve.column("evaluation_distance_m");
  std::vector<double> values;
  for (const auto& row : curve.rows)
    if (row[x] > from && row[x] <= to) values.push_back(row[y]);
  return values.empty() ? NAN : mean(values);
}

std::string plus_minus(const std::vector<double>& values) {
  if (values.size() < 2) return fmt::format("{:.2f}", mean(values));
  return fmt::format("{:.2f} ± {:.2f}", mean(values),
                     standard_deviation(values) / std::sqrt(static_cast<double>(values.size())));
}

std::string report_of(const std::vector<ArmResult>& results, const ExperimentOptions& options) {
  std::string text = fmt::format(
      "# Baseline against shaping\n\nDistance in 10 s (m) without noise, mean ± standard error "
      "over "
      "{} paired seeds; half and full: means of the evaluations in the last tenth of {} and {} "
      "decisions.\n\n| arm | half | full |\n|---|---|---|\n",
      results.front().full_m.size(), options.train.run.decisions / 2, options.train.run.decisions);
  for (const ArmResult& arm : results)
    text += fmt::format("| {} | {} | {} |\n", arm.label, plus_minus(arm.half_m),
                        plus_minus(arm.full_m));
  text +=
      "\nRatio to the baseline over paired seeds, 95 % interval:\n\n| arm | half | full |\n"
      "|---|---|---|\n";
  const auto ratio_text = [](const PairedRatio& r) {
    if (!std::isfinite(r.ratio)) return std::string("not defined");
    return fmt::format("{:.2f} ({:.2f} … {:.2f})", r.ratio, r.low, r.high);
  };
  for (std::size_t i = 1; i < results.size(); ++i)
    text += fmt::format("| {} | {} | {} |\n", results[i].label,
                        ratio_text(paired_ratio(results[i].half_m, results[0].half_m)),
                        ratio_text(paired_ratio(results[i].full_m, results[0].full_m)));
  text += "\nEach seed, half → full:\n\n";
  for (const ArmResult& arm : results) {
    text += fmt::format("- {}:", arm.label);
    for (std::size_t i = 0; i < arm.full_m.size(); ++i)
      text += fmt::format(" {:.2f} → {:.2f}{}", arm.half_m[i], arm.full_m[i],
                          i + 1 < arm.full_m.size() ? ";" : "\n");
  }
  text += "\n![distance against decisions](decisions.png)\n\n![against wall clock](wall.png)\n";
  return text;
}

/// Copies what a reader needs of each run.
void copy_runs(const std::vector<Job>& jobs, const fs::path& report) {
  for (const Job& job : jobs) {
    const fs::path to = report / job.arm / std::to_string(job.seed);
    for (const char* name : {"config.toml", "curve.csv", "timing.csv"})
      write_file_atomically(to / name, read_file(job.run / name));
  }
}

}  // namespace

PairedRatio paired_ratio(const std::vector<double>& treated, const std::vector<double>& control) {
  std::vector<double> logs;
  for (std::size_t i = 0; i < std::min(treated.size(), control.size()); ++i)
    logs.push_back(std::log(treated[i] / control[i]));
  if (logs.size() < 2) return {NAN, NAN, NAN};
  const double half_width = student_95(logs.size() - 1) * standard_deviation(logs) /
                            std::sqrt(static_cast<double>(logs.size()));
  return {std::exp(mean(logs)), std::exp(mean(logs) - half_width),
          std::exp(mean(logs) + half_width)};
}

std::vector<ArmResult> results_of(const std::vector<Arm>& arms, std::int64_t decisions) {
  std::vector<ArmResult> results;
  const auto budget = static_cast<double>(decisions);
  for (const Arm& arm : arms) {
    ArmResult result{.label = arm.label, .half_m = {}, .full_m = {}};
    for (const fs::path& run : arm.runs) {
      const Table curve = load_table(run / "curve.csv", "curve", 1);
      result.half_m.push_back(mean_between(curve, 0.45 * budget, 0.5 * budget));
      result.full_m.push_back(mean_between(curve, 0.9 * budget, 1.1 * budget));
    }
    results.push_back(std::move(result));
  }
  return results;
}

bool run_experiment(const ExperimentOptions& options, const std::atomic<bool>& stop,
                    std::FILE* messages) {
  require(options.seeds >= 1, "--seeds {}: must be at least 1", options.seeds);
  const std::vector<Job> jobs = jobs_of(options);
  for (const Job& job : jobs) begin(job, options);
  Crew crew(options.jobs);
  crew.run(static_cast<int>(jobs.size()), [&](int i) {
    const Job& job = jobs[static_cast<std::size_t>(i)];
    if (stop || fs::exists(job.run / "finished")) return;
    fmt::print(messages, "{} seed {}: begins\n", job.arm, job.seed);
    const std::string outcome = work_on(job, stop);
    fmt::print(messages, "{} seed {}: {}\n", job.arm, job.seed, outcome);
    std::fflush(messages);
  });
  if (stop) return false;

  std::vector<fs::path> runs;
  for (const Job& job : jobs) runs.push_back(job.run);
  const std::vector<Arm> arms = arms_of(runs);
  copy_runs(jobs, options.report);
  write_file_atomically(options.report / "results.md",
                        report_of(results_of(arms, options.train.run.decisions), options));
  for (const char* against : {"decisions", "wall"})
    plot(arms, {.against = against, .out = options.report / against});
  return true;
}

}  // namespace stride
