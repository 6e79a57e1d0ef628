#pragma once

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <string>

#include "extract/parallel/ranks.h"
#include "train/training/demonstration.h"
#include "train/training/training.h"

namespace stride::training {

/// The result of train().
struct TrainSummary {
  Progress progress;
  bool finished = false;   // the decisions of the configuration are done
  std::string divergence;  // why learning diverged; empty if it did not
  std::string unsaved;     // why the last checkpoint or row was not written; empty if it was
  double distance_m = 0;   // of the last evaluation
  std::string brief_report() const;
};

/// Creates a run folder with config.toml and the demonstration. Throws Error if `run` already holds
/// a run.
void make_run_folder(const TrainOptions& options, const Demonstration& demonstration,
                     const std::filesystem::path& run);

/// Throws Error if `run` holds a run of other options, naming the first, or of another potential.
void require_same_run(const TrainOptions& options, const Demonstration& demonstration,
                      const std::filesystem::path& run);

/// Replaces RUN/config.toml.
void write_run_options(const TrainOptions& options, const std::filesystem::path& run);

TrainOptions load_run_options(const std::filesystem::path& run);

/// Trains the run in that folder from its checkpoint, or from the beginning if it has none, until
/// its decisions are done or `stop` is set. Writes a checkpoint at the end.
///
/// Writes curve.csv (`# stride curve 1`: a row each evaluation; it depends on the configuration and
/// its seed alone, not on threads, speed or interruptions), timing.csv (`# stride timing 1`: wall
/// clock of the same rows), agent.safetensors and best.safetensors (policy.h). `messages` (or null)
/// receives the progress. A full disk is reported and writing is tried again later; if it is still
/// full at the end, the summary says so, and the run continues from the previous checkpoint.
/// All `ranks` make the call together; the summary is whole in the first.
TrainSummary train(const std::filesystem::path& run, const EnvironmentFactory& make_environment,
                   const std::atomic<bool>& stop, std::FILE* messages,
                   parallel::Ranks& ranks = parallel::Ranks::alone());

}  // namespace stride::training
