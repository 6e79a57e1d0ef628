#pragma once

#include <string>
#include <vector>

#include "calibrate/osim/model.h"
#include "train/simulation/competition/rules.h"
#include "train/simulation/engine/engine.h"

namespace stride::competition {

/// The observation of a runner, by name. The first 41 are the competition's, in its order:
///
///    0   pelvis_tilt pelvis_tx pelvis_ty, then their speeds: suffix _u
///    6   hip_flexion_r knee_angle_r ankle_angle_r hip_flexion_l knee_angle_l ankle_angle_l
///   12   their speeds: suffix _u
///   18   com_x com_y com_vx com_vy
///   22   x and y of the origins of head pelvis torso toes_l toes_r talus_l talus_r
///   36   strength_psoas_l strength_psoas_r
///   38   obstacle_x obstacle_y obstacle_radius: of the first obstacle whose far end is not behind
///        the pelvis, x from the pelvis; 100 0 0 if there is none
///
/// then additional ones: velocities of those origins (suffixes _vx, _vy), positions and velocities
/// of the origins of tibia (the knee) and calcn (the heel), and each muscle's raw activation. rad,
/// m, s; all but obstacle_x in the ground's axes, from its origin.
class Sensors {
 public:
  /// Throws Error if the model lacks one of those bodies.
  explicit Sensors(const osim::Model& model);

  static constexpr int kCompetition = 41;
  static const std::vector<std::string>& names();

  /// Writes names().size() values.
  void read(const simulation::RunnerState& state, const simulation::RunnerKinematics& kinematics,
            const Scene& scene, Rules rules, int max_obstacles, double* values) const;

 private:
  std::vector<int> bodies_;  // of the model: first the competition's seven, then tibia and calcn
  double mass_kg_ = 0;
};

/// The next obstacle, x from the pelvis; {100, 0, 0} if there is none.
simulation::Obstacle next_obstacle(const Scene& scene, double pelvis_x_m);

}  // namespace stride::competition
