#pragma once

// C++17-clean and free of Simbody and Eigen.

#include <array>
#include <string>

#include "calibrate/osim/model.h"
#include "train/simulation/engine/engine.h"

namespace stride::simulation {

/// Where the elements of a RunnerState are in a model.
struct RunnerLayout {
  std::array<int, kCoordinates> coordinate{};  // index into Model::coordinates
  std::array<int, kMuscles> muscle{};          // index into Model::muscles
};

/// Names of the muscles in the competition's order: hamstrings_r … tib_ant_r, hamstrings_l …
/// tib_ant_l.
const std::array<std::string, kMuscles>& muscle_names();

/// Throws Error unless the model has exactly the runner's muscles, and its coordinates as the only
/// ones that are not locked.
RunnerLayout runner_layout(const osim::Model& model);

/// The state in which the model's file leaves it: default coordinates and speeds, activations 0.05,
/// fibres of the file's default length, else OpenSim's 0.1 m (O1).
RunnerState default_state(const osim::Model& model);

/// The same in the mirror: right and left legs exchanged.
RunnerState mirrored(const RunnerState& state);
Excitations mirrored(const Excitations& excitations);

}  // namespace stride::simulation
