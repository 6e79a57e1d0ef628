#pragma once

#include <Eigen/Core>
#include <array>

#include "extract/skeleton/body_part.h"
#include "videos/gait_curves.h"

namespace stride::videos {

/// Lengths between joint centres, m.
struct Proportions {
  double thigh = 0.429, shank = 0.428;  // of Rajagopal's subject
  double toe_forward = 0.205, toe_down = 0.058, heel_back = 0.07,
         sole_down = 0.084;           // from the ankle
  double trunk = 0.57, neck = 0.165;  // hips to shoulders, shoulders to the centre of the head
  double upper_arm = 0.30, forearm = 0.255;
  double hip_half_width = 0.085, ankle_half_width = 0.05, shoulder_half_width = 0.19;
};

/// Positions and angles of the runner's parts, m and rad. x in the running direction, y up, z to
/// the runner's right; index 0 right, 1 left.
struct Skeleton {
  double phase = 0;
  double pelvis_tilt = 0;
  std::array<double, 2> hip_flexion{}, knee_angle{}, ankle_angle{};
  Eigen::Vector3d pelvis, shoulders, head;  // the midpoint of the hips, of the shoulders
  std::array<Eigen::Vector3d, 2> hip, knee, ankle, toe, heel, shoulder, elbow, wrist;
  double trunk_lean = 0, head_pitch = 0;
  /// Angle of a segment from straight down, forward positive; of the foot, toes up.
  std::array<double, 2> thigh_angle{}, shank_angle{}, foot_angle{}, upper_arm_angle{},
      forearm_angle{};

  const Eigen::Vector3d& operator[](BodyPart part) const;
};

/// The angles of a runner at one moment, rad, and how far the parts of the trunk are off.
struct Posture {
  double phase = 0;
  double pelvis_tilt = 0, trunk_lean = 0, stretch = 1;  // of the trunk's length
  std::array<double, 2> hip_flexion{}, knee_angle{}, ankle_angle{};
  std::array<double, 2> upper_arm{}, elbow{};
  std::array<Eigen::Vector2d, 2> hip_offset{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  std::array<double, 2> shoulder_back_m{};
};

/// A runner in a posture, hips at (x, height).
Skeleton stand(const Posture& posture, const Proportions& proportions, double x_m,
               double pelvis_height_m);

/// Deviations from the mean stride, rad.
struct Deviation {
  std::array<double, 2> hip{}, knee{}, ankle{};
};

/// Poses the runner at a phase of the stride, with the hips at (x, height).
Skeleton pose(const GaitCurves& gait, const Proportions& proportions, double phase, double x_m,
              double pelvis_height_m, const Deviation& deviation = {});

/// Height of the lowest point of a shoe above the ground.
double clearance(const Skeleton& skeleton, const Proportions& proportions, int side);

/// Height and speed of a gait with these proportions.
struct Grounding {
  double mean_height_m =
      0;                 // of the hips, so that the lowest shoe of the stride touches the ground
  double speed_m_s = 0;  // so that the shoe that is on the ground stands still on average
};
Grounding ground(const GaitCurves& gait, const Proportions& proportions);

/// Replaces the pelvis height by one that keeps the lower shoe on the ground, plus a hop of `hop_m`
/// in each flight; for gaits whose height was not measured with these legs and angles.
GaitCurves standing(GaitCurves gait, const Proportions& proportions, double hop_m);

}  // namespace stride::videos
