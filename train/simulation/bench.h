#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "train/simulation/engine/engine.h"
#include "train/simulation/engine/recording.h"

namespace stride::simulation {

/// How fast an engine is, under one of two workloads. Random: excitations uniform in [0, 1], held
/// for ten steps of 0.01 s; episodes from equilibrium under the rules `clean`, restarted at a fall
/// or after 1000 steps. Running: the excitations of a recorded run, from its state, put back onto
/// it every second, so that what small differences make of it counts for little.
struct BenchOptions {
  double seconds = 2;  // of wall time, for each engine
  long steps = 0;      // if positive: this many steps instead, on each thread
  int threads = 1;
  int obstacles = 0;  // drawn anew for each episode
  std::uint64_t seed = 1;
  EngineOptions engine;
  std::optional<Recording> running;  // unset: random
};

struct BenchResult {
  std::string engine, workload;  // workload: random or running
  int threads = 1;
  double accuracy = 0;
  long steps = 0, evaluations = 0, integration_steps = 0, rejected = 0;
  long falls = 0, time_limits = 0, failures = 0;    // how episodes ended
  std::string first_failure;                        // what the first failure said
  double wall_s = 0, cpu_s = 0;                     // cpu_s: of all threads
  double resident_start_MiB = 0, resident_MiB = 0;  // after the first hundredth, and at the end

  double steps_per_s() const { return steps / wall_s; }
  double steps_per_cpu_s() const { return steps / cpu_s; }
  double realtime_factor() const { return 0.01 * steps_per_s(); }
  double evaluations_per_step() const { return static_cast<double>(evaluations) / steps; }
  double us_per_evaluation() const { return 1e6 * cpu_s / evaluations; }
};

/// Runs the engines in turns, so that a busy machine slows all equally. Threads share nothing.
std::vector<BenchResult> bench(const std::vector<std::string>& engines, const osim::Model& model,
                               const BenchOptions& options);

/// Cost and error of an accuracy: rollouts of one second (or until a fall) under the bench's
/// excitations, compared with the planar engine at an accuracy of 1e-9.
struct AccuracyRow {
  std::string engine;
  double accuracy = 0;
  double evaluations_per_step = 0, steps_per_cpu_s = 0;
  /// Largest difference of any coordinate, rad or m: median, 90th percentile, worst of the
  /// rollouts.
  double median_error = 0, p90_error = 0, worst_error = 0;
};

struct AccuracyOptions {
  int rollouts = 24;
  std::uint64_t seed = 1;
  std::vector<std::string> engines;
  std::vector<double> accuracies{1e-1, 1e-2, 1e-3, 1e-4, 1e-5};
};

std::vector<AccuracyRow> accuracy_table(const osim::Model& model, const AccuracyOptions& options);

}  // namespace stride::simulation
