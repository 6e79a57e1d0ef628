#pragma once

#include <array>

#include "calibrate/osim/simm_spline.h"
#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/planar/model.h"

namespace stride::planar {

/// Model::coordinates index of hip, knee, ankle of either leg.
using JointCoordinates = std::array<std::array<int, 2>, 3>;

/// Fills in the knee's functions and the muscles' paths of a PlanarModel whose bodies are placed:
/// the pieces of each muscle between segments for every set of conditional points that can be
/// present, the rest of its length as a constant. Throws Error if a path is not of this kind.
void build_planar_paths(const osim::Model& model, const simulation::RunnerLayout& layout,
                        const JointCoordinates& joints,
                        const std::array<osim::SplineCoefficients, 2>& knee_x,
                        const std::array<osim::SplineCoefficients, 2>& knee_y, PlanarModel& planar);

}  // namespace stride::planar
