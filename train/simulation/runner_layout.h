#pragma once

// C++17-clean and free of Simbody and Eigen.

#include <array>
#include <string>

#include "calibrate/model.h"
#include "train/simulation/engine.h"

namespace stride {

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
RunnerLayout runner_layout(const Model& model);

/// The same in the mirror: right and left legs exchanged.
RunnerState mirrored(const RunnerState& state);
Excitations mirrored(const Excitations& excitations);

}  // namespace stride
