#pragma once

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <string>

#include "train/options.h"

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
  std::string command;              // as it was given, for the report
};

/// Runs what is not done yet, continuing runs that were interrupted; then writes the report:
/// curves, configurations, results.md and the figures. Returns false if it was stopped.
bool run_experiment(const ExperimentOptions& options, const std::atomic<bool>& stop,
                    std::FILE* messages);

}  // namespace stride
