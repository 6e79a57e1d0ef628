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

/// Of the ground. Adds springs and dampers to `linear`, if given.
FootForces touch_ground(const PlanarModel& model, const PlanarState& state,
                        const PlanarKinematics& k, bool drop_contacts, PlanarLinear* linear);

/// Adds those of the obstacles.
void touch_obstacles(const PlanarModel& model, const std::vector<PlanarObstacle>& obstacles,
                     const PlanarState& state, const PlanarKinematics& k, FootForces& feet,
                     PlanarLinear* linear);

}  // namespace stride::planar
