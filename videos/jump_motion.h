#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "videos/skeleton.h"

namespace stride::videos {

/// A measured jump: the midpoint of the hips and the joint angles in time, before and after which
/// the jumper stands as at the ends.
class JumpMotion {
 public:
  struct Row {
    double time_s = 0, x_m = 0, height_m = 0, pelvis_tilt = 0;  // rad, signs as in GaitCurves
    std::array<double, 2> hip_flexion{}, knee_angle{}, ankle_angle{};
  };

  /// The jump of videos/jump_kinematics.csv, for legs of 0.4215 and 0.4099 m. The pelvis is raised
  /// and the ankles are turned by constants so that the shoes of `proportions` lie on the ground.
  explicit JumpMotion(const Proportions& proportions);

  const std::string& source() const { return source_; }
  double duration_s() const { return rows_.back().time_s; }
  double length_m() const { return rows_.back().x_m; }  // that the pelvis moves

  /// Linear between the measured rows, 1/60 s apart.
  Row at(double time_s) const;
  /// The jumper at that time. Trunk and arms are by eye.
  Skeleton skeleton(double time_s) const;

  /// When the last shoe leaves the ground, and when the first one is back.
  double take_off_s() const { return take_off_s_; }
  double landing_s() const { return landing_s_; }

 private:
  double lower_shoe_m(double time_s) const;

  std::string source_;
  Proportions proportions_;
  std::vector<Row> rows_;
  double take_off_s_ = 0, landing_s_ = 0;
};

}  // namespace stride::videos
