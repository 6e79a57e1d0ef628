#include "shaping/pose.h"

#include <algorithm>
#include <cmath>

namespace stride {

Pose Pose::mirrored() const {
  Pose mirrored;
  for (const ComparedPart& each : kPoseParts)
    std::ranges::copy(numbers(each.mirrored), mirrored.numbers(each.part).begin());
  return mirrored;
}

std::array<double, kLegAngles> leg_angles(const Pose& pose) {
  const auto forward = [](const Eigen::Vector2d& line) { return std::atan2(line.x(), -line.y()); };
  std::array<double, kLegAngles> angles{};
  for (std::size_t i = 0; const auto& [knee, foot] : {std::pair(PosePart::knee_r, PosePart::foot_r),
                                                      {PosePart::knee_l, PosePart::foot_l}}) {
    const double thigh = forward(pose[knee]);
    angles[i++] = thigh;
    angles[i++] = thigh - forward(pose[foot] - pose[knee]);
  }
  return angles;
}

}  // namespace stride
