#pragma once

// C++17-clean and free of Simbody and Eigen.

#include <array>
#include <string>

#include "calibrate/osim/model.h"
#include "train/simulation/engine/engine.h"

namespace stride::simulation {

/// Maps the elements of a RunnerState to a model.
struct RunnerLayout {
  std::array<int, kCoordinates> coordinate{};  // index into Model::coordinates
  std::array<int, kMuscles> muscle{};          // index into Model::muscles
};

/// Names of the muscles in the competition's order: hamstrings_r … tib_ant_r, hamstrings_l …
/// tib_ant_l.
const std::array<std::string, kMuscles>& muscle_names();

/// Throws Error unless the model has exactly the runner's muscles and unlocked coordinates.
RunnerLayout runner_layout(const osim::Model& model);

/// The default state of the model's file: coordinates and speeds, activations 0.05, default fibre
/// lengths of the file, else OpenSim's 0.1 m.
RunnerState default_state(const osim::Model& model);

/// The mirrored state: right and left leg exchanged.
RunnerState mirrored(const RunnerState& state);
Excitations mirrored(const Excitations& excitations);

}  // namespace stride::simulation
