#pragma once

#include <array>

#include "calibrate/osim/simm_spline.h"
#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/planar/planar_model.h"

namespace stride::planar {

/// Model::coordinates index of hip, knee, ankle of either leg.
using JointCoordinates = std::array<std::array<int, 2>, 3>;

/// Sets the knee's functions and the muscles' paths of a PlanarModel whose bodies are placed. A
/// path consists of at most two straight pieces between segments, for every possible set of
/// conditional points; pieces within a segment are added to a constant. Throws Error with the
/// reason if a path cannot be represented like this.
void build_planar_paths(const osim::Model& model, const simulation::RunnerLayout& layout,
                        const JointCoordinates& joints,
                        const std::array<osim::SplineCoefficients, 2>& knee_x,
                        const std::array<osim::SplineCoefficients, 2>& knee_y, PlanarModel& planar);

}  // namespace stride::planar
