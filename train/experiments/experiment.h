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
  /// Runs to do, as "ARM/SEED"; empty: all. With it there is no report: others may be at work.
  std::vector<std::string> only;
  bool merge = false;  // train nothing: report over the runs that are there
};

/// What became of the claim, from the curves that are kept beside `file`: a row of a table in
/// Markdown with its name, the claim, the ratio with its interval, and the verdict.
std::string verdict_row(const std::filesystem::path& file);
inline constexpr const char* kVerdictHeading =
    "| experiment | claim | arms | seeds | ratio (95 %) | bootstrap | verdict |\n"
    "|---|---|---|---|---|---|---|\n";

/// All runs of the experiment, as "ARM/SEED", in the order in which they are done. Throws Error for
/// a potential or clip that is missing or that its arm cannot use.
std::vector<std::string> run_names(const ExperimentFile& experiment);

/// Runs what is not done yet, continuing runs that were interrupted; then writes the report:
/// curves, configurations, results.md and the figures. Returns false if it was stopped. The ranks
/// of mpirun share the runs, and the first one writes the report. To merge is to report over the
/// seeds that are finished in every arm; `messages` is told which runs are missing. Throws Error if
/// none is left, or for a run that the experiment does not have.
bool run_experiment(const ExperimentOptions& options, const std::atomic<bool>& stop,
                    std::FILE* messages);

}  // namespace stride::experiments
