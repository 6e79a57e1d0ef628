#pragma once

// C++17-clean and free of Simbody and Eigen.

#include <vector>

#include "train/simulation/engine/engine.h"
#include "train/simulation/laws/path.h"

namespace stride::laws {

/// A model in a state: coordinates and speeds in the order of Model::coordinates, frames in that of
/// Model::bodies.
struct PlacedRunner {
  std::vector<double> q, u;
  std::vector<BodyFrame> frames;

  /// A point fixed in a body (-1: the ground), in the ground.
  osim::Vec3 point(int body, const osim::Vec3& location_m) const {
    if (body < 0) return location_m;
    const BodyFrame& f = frames[body];
    return {f.origin_m[0] + f.cos * location_m[0] - f.sin * location_m[1],
            f.origin_m[1] + f.sin * location_m[0] + f.cos * location_m[1],
            f.origin_m[2] + location_m[2]};
  }

  /// Velocity of the material point of a body at a position in axes of the ground.
  simulation::PlanarVector velocity(int body, const osim::Vec3& point_m) const {
    if (body < 0) return {};
    const BodyFrame& f = frames[body];
    return {f.vx_m_s - f.omega_rad_s * (point_m[1] - f.origin_m[1]),
            f.vy_m_s + f.omega_rad_s * (point_m[0] - f.origin_m[0])};
  }
};

}  // namespace stride::laws
