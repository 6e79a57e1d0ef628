#pragma once

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <string>

#include "train/experiments/experiment_file.h"

namespace stride::experiments {

struct ExperimentOptions {
  ExperimentFile experiment;
  int jobs = 2;                  // runs side by side, each on one core
  std::filesystem::path runs;    // folder of the run folders: <arm>/<seed>
  std::filesystem::path report;  // where curves, configurations and figures are copied to
  std::string command;           // as it was given, for the report
};

/// Runs everything that is not done yet, continuing interrupted runs; then writes the report:
/// curves, configurations, results.md and figures. Returns false if it was stopped.
bool run_experiment(const ExperimentOptions& options, const std::atomic<bool>& stop,
                    std::FILE* messages);

}  // namespace stride::experiments
