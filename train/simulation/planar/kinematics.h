#pragma once

#include <array>

#include "train/simulation/planar/model.h"
#include "train/simulation/planar/state.h"
#include "train/simulation/simd/pair.h"

namespace stride::planar {

/// Where everything is and how it moves, in axes of the ground; positions are relative to the
/// pelvis' origin. Index: segment, 0 the base.
struct PlanarKinematics {
  simd::V2 cos[4], sin[4], omega[4];
  simd::Pair origin[4], center[4];
  simd::Pair hinge;        // about which the shank turns in the thigh at this moment
  simd::Pair hinge_speed;  // of the knee's origin in the thigh, per speed of the knee
  simd::Pair hinge_bend;   // its second derivative
  simd::V2 knee_speed;
  simd::Pair velocity_of_foot;  // of its origin in the ground
  // Moving points in the shank, and their derivative by the knee angle.
  std::array<simd::Pair, PlanarModel::kFunctions> moving, moving_slope;

  simd::Pair turn(int segment, simd::Pair v) const {
    return {cos[segment] * v.x - sin[segment] * v.y, sin[segment] * v.x + cos[segment] * v.y};
  }
};

/// Which interval of the knee table held at the last look: the next one is close.
using KneeIntervals = std::array<int, PlanarModel::kLegs>;

void place(const PlanarModel& model, const PlanarState& state, KneeIntervals& interval,
           PlanarKinematics& k);

/// On either foot: force, and moment about the pelvis' origin. N, N·m.
struct FootForces {
  simd::V2 x{}, y{}, moment{};
};

}  // namespace stride::planar
