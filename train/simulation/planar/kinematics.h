#pragma once

#include <array>

#include "train/simulation/planar/planar_model.h"
#include "train/simulation/planar/state.h"
#include "train/simulation/simd/pair.h"

namespace stride::planar {

/// Positions and velocities in axes of the ground; positions are relative to the pelvis origin.
/// Index: segment, 0 the base. ../README.md (1) to (3).
struct PlanarKinematics {
  simd::V2 cos[4], sin[4], omega[4];
  simd::Pair origin[4], center[4];
  simd::Pair hinge;        // K*, the instantaneous centre of the knee, (2)
  simd::Pair hinge_speed;  // R₁ k'
  simd::Pair hinge_bend;   // R₁ k''
  simd::V2 knee_speed;
  simd::Pair velocity_of_foot;  // of its origin in the ground
  // Moving path points in the shank, and their derivatives with respect to the knee angle.
  std::array<simd::Pair, PlanarModel::kFunctions> moving, moving_slope;

  simd::Pair turn(int segment, simd::Pair v) const {
    return {cos[segment] * v.x - sin[segment] * v.y, sin[segment] * v.x + cos[segment] * v.y};
  }
};

/// The interval of each knee table at the last evaluation, where the next search begins.
using KneeIntervals = std::array<int, PlanarModel::kLegs>;

void place(const PlanarModel& model, const PlanarState& state, KneeIntervals& interval,
           PlanarKinematics& k);

/// Contact force on each foot and its moment about the pelvis origin. N, N·m.
struct FootForces {
  simd::V2 x{}, y{}, moment{};
};

}  // namespace stride::planar
