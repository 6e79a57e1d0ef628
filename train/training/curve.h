#pragma once

#include <filesystem>

#include "extract/io/table.h"
#include "train/network/policy.h"
#include "train/training/training.h"

namespace stride::training {

/// curve.csv, `# stride curve 1`: one row an evaluation. Columns: decisions, simulated_s, updates,
/// episodes, falls, failures (all since the beginning); evaluation_distance_m, evaluation_reward,
/// evaluation_time_s, evaluation_falls (of episodes without noise, means); training_distance_m,
/// training_reward (means over the episodes with noise that ended since the last row; empty: none);
/// critic_loss, q, target, actor_gradient, critic_gradient (means over the updates since then).
/// A distance is the measure of the task; of another task than `distance` the metadata name it.
Table new_curve(const std::string& task = "distance");

/// A row of the curve. Its columns are in the order and of the names of the members.
struct CurveRow {
  double decisions = 0, simulated_s = 0, updates = 0, episodes = 0, falls = 0, failures = 0;
  double evaluation_distance_m = 0, evaluation_reward = 0, evaluation_time_s = 0,
         evaluation_falls = 0;
  double training_distance_m = 0, training_reward = 0;
  double critic_loss = 0, q = 0, target = 0, actor_gradient = 0, critic_gradient = 0;

  std::vector<double> values() const;
};

CurveRow curve_row(const Progress& progress, double simulated_s,
                   const std::vector<network::EpisodeSummary>& evaluation);

/// timing.csv, `# stride timing 1`: decisions, wall_s (of training, pauses excluded), steps_per_s,
/// updates_per_s (since the row before).
Table new_timing();

/// Reads the first `rows` rows of RUN/curve.csv or timing.csv, to continue them.
Table load_rows(const std::filesystem::path& file, const Table& empty, std::int64_t rows);

}  // namespace stride::training
