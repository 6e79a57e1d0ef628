#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/osim/model.h"
#include "extract/io/table.h"
#include "train/simulation/competition/rules.h"
#include "train/simulation/engine/engine.h"
#include "train/simulation/make_engine.h"

namespace stride::simulation {

struct SimulateOptions {
  std::string engine = simulation::kDefaultEngine;
  competition::Rules rules = competition::Rules::clean;
  double accuracy = 1e-3;
  /// true: fibres start in equilibrium; false: at the file's length, else 0.1 m. Unset: by the
  /// rules.
  std::optional<bool> equilibrate;
  competition::Scene scene;
};

/// A sequence of excitations, one a step of 0.01 s.
struct ExcitationSequence {
  std::vector<Excitations> steps;
  int clipped = 0;  // values that were outside of [0, 1]
};

/// Reads a CSV with a row for each step and a column for each muscle, by name, in any order; a
/// column `time_s` is ignored. Values outside [0, 1] are clipped, as in the competition. Throws
/// Error for a missing, unknown or duplicate muscle and for an invalid value.
ExcitationSequence load_excitations(const std::filesystem::path& file);

/// Reads a CSV with columns x_m, y_m, radius_m; sorted by x. Throws Error for anything else.
std::vector<Obstacle> load_obstacles(const std::filesystem::path& file);

struct Simulation {
  /// One row for the initial state and one after every step: time_s, nine coordinates, nine speeds
  /// (suffix _u), and those of the competition's 41 observations that are neither.
  Table table;
  std::optional<double> fell_at_s;
  std::string failure;  // why it stopped early; empty if it did not
  long evaluations = 0;
};

/// Runs the excitations from the rules' initial state, to the end even if the runner falls.
Simulation simulate(const osim::Model& model, const std::vector<Excitations>& excitations,
                    const SimulateOptions& options);

}  // namespace stride::simulation
