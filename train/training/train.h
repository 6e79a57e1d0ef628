#pragma once

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <string>

#include "train/training/demonstration.h"
#include "train/training/training.h"

namespace stride::training {

/// How a call of train() went.
struct TrainSummary {
  Progress progress;
  bool finished = false;   // the decisions of the configuration are done
  std::string divergence;  // why learning was stopped; empty: it was not
  std::string unsaved;     // why the last checkpoint or row was not written; empty: it was
  double distance_m = 0;   // of the last evaluation
  std::string brief_report() const;
};

/// Writes what a run needs to begin: config.toml, and what there is of a demonstration. Throws
/// Error where `run` holds a run already.
void make_run_folder(const TrainOptions& options, const Demonstration& demonstration,
                     const std::filesystem::path& run);

/// Replaces RUN/config.toml.
void write_run_options(const TrainOptions& options, const std::filesystem::path& run);

TrainOptions load_run_options(const std::filesystem::path& run);

/// Trains the run in that folder: from its beginning, or from its checkpoint if it has one, until
/// its decisions are done or `stop` is set; then a checkpoint is there to continue from.
///
/// Writes curve.csv (`# stride curve 1`: a row each evaluation; it depends on the configuration and
/// its seed alone, not on threads, speed or interruptions), timing.csv (`# stride timing 1`: wall
/// clock of the same rows), agent.safetensors and best.safetensors (policy.h). `messages` (or
/// null) gets the progress. A disk that is full is reported, and writing is tried again later; if
/// it still is at the end, the summary says so, and the run continues from the checkpoint before.
TrainSummary train(const std::filesystem::path& run, const EnvironmentFactory& make_environment,
                   const std::atomic<bool>& stop, std::FILE* messages);

}  // namespace stride::training
