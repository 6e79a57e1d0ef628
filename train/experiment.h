#pragma once

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "train/options.h"
#include "train/plot.h"

namespace stride {

/// "Performance comparison between the baseline and the reward shaping approach", the paper's
/// figure: the same agent without and with a potential, same seeds, same budget.
struct ExperimentOptions {
  TrainOptions train;               // of every run; seed and potential are set by the arm
  std::filesystem::path potential;  // of the arm `shaped`
  std::filesystem::path weak;       // of the arm `weak`, made of an agent's own run; or empty
  int seeds = 5;                    // 1, 2, …, the same in each arm
  int jobs = 2;                     // runs side by side, each on one core
  std::filesystem::path runs;       // folder of the run folders: <arm>/<seed>
  std::filesystem::path report;     // where curves, configurations and figures are copied to
};

/// One arm's distances, an element a seed: means of the evaluations in the last tenth of half the
/// budget and of the whole.
struct ArmResult {
  std::string label;
  std::vector<double> half_m, full_m;
};

/// A ratio over paired seeds: exp of the mean of log ratios, with Student's 95 % interval.
struct PairedRatio {
  double ratio = 0, low = 0, high = 0;  // NaN where there are too few seeds, or a distance ≤ 0
};
PairedRatio paired_ratio(const std::vector<double>& treated, const std::vector<double>& control);

/// From the curves that are there.
std::vector<ArmResult> results_of(const std::vector<Arm>& arms, std::int64_t decisions);

/// Runs what is not done yet, continuing runs that were interrupted; then writes the report:
/// curves, configurations, results.md and the figures. Returns false if it was stopped.
bool run_experiment(const ExperimentOptions& options, const std::atomic<bool>& stop,
                    std::FILE* messages);

}  // namespace stride
