#pragma once

#include <vector>

#include "train/simulation/laws/contact.h"
#include "train/simulation/planar/kinematics.h"

namespace stride::planar {

struct PlanarLinear;

struct PlanarObstacle {
  double x_m = 0, y_m = 0, radius_m = 0;
  laws::ContactLaw law;
};

/// Contact of the feet with the ground. If `linear` is given, adds stiffness and damping to it.
FootForces touch_ground(const PlanarModel& model, const PlanarState& state,
                        const PlanarKinematics& k, double dropped, PlanarLinear* linear);

/// Adds the contact with obstacles.
void touch_obstacles(const PlanarModel& model, const std::vector<PlanarObstacle>& obstacles,
                     const PlanarState& state, const PlanarKinematics& k, FootForces& feet,
                     PlanarLinear* linear);

}  // namespace stride::planar
