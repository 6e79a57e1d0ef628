#include "calibrate/fit/solver/marks.h"

#include <algorithm>

namespace stride::fit {

Marks observe(const Trajectory& trajectory, bool to_left, Heels heels) {
  constexpr double kLeastWeight = 0.05;
  Marks all;
  all.to_left = to_left;
  const double first_s = trajectory.frames.front().time_s, last_s = trajectory.frames.back().time_s;
  all.middle_s = 0.5 * (first_s + last_s);
  all.duration_s = last_s - first_s;
  const Eigen::Vector2d center(0.5 * trajectory.width_px, 0.5 * trajectory.height_px);
  for (std::size_t i = 0; i < trajectory.frames.size(); ++i) {
    const TrajectoryFrame& frame = trajectory.frames[i];
    all.u_s.push_back(frame.time_s - all.middle_s);
    for (const BodyPart part : kBodyParts) {
      const Point& point = frame[part];
      if (!point.present()) continue;
      const Eigen::Vector2d from_center = point.p_px - center;
      ++all.count[index(part)];
      all.points.push_back(
          {.frame = static_cast<int>(i),
           .u_s = all.u_s.back(),
           .part = part,
           .z_px = {to_left ? -from_center.x() : from_center.x(), -from_center.y()},
           .weight = std::clamp(point.confidence, kLeastWeight, 1.0)});
    }
  }
  if (heels == Heels::left_out || !all.sees_toes() || !all.sees_heels()) {
    std::erase_if(all.points, [](const Mark& mark) { return is_heel(mark.part); });
    all.count[index(BodyPart::heel_r)] = all.count[index(BodyPart::heel_l)] = 0;
  }
  return all;
}

Eigen::Vector2d image_px(const Trajectory& trajectory, bool to_left, const Eigen::Vector2d& z_px) {
  return {0.5 * trajectory.width_px + (to_left ? -z_px.x() : z_px.x()),
          0.5 * trajectory.height_px - z_px.y()};
}

}  // namespace stride::fit
