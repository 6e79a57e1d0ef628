#include "calibrate/fit/ground_slope.h"

#include <algorithm>
#include <cmath>

#include "extract/io/statistics.h"
#include "extract/skeleton/robust_fit.h"

namespace stride::fit {

std::optional<Prior> ground_roll(const Trajectory& trajectory) {
  constexpr double kLine = 0.01, kLeast = 0.005, kSure = 0.017;  // rad
  // Image axes have y down: a floor that falls to the right has a positive slope there.
  if (std::isfinite(trajectory.floor_roll_rad)) return Prior{-trajectory.floor_roll_rad, kLine};
  std::vector<Eigen::Vector2d> displacements;
  Eigen::Vector2d passed = Eigen::Vector2d::Zero();
  for (const TrajectoryFrame& frame : trajectory.frames)
    if (frame.camera_px.allFinite()) {
      displacements.push_back(frame.camera_px);
      passed += frame.camera_px;
    }
  if (displacements.size() < 8 || std::abs(passed.x()) < 0.5 * trajectory.width_px)
    return std::nullopt;
  // y = x tan φ, and the camera's own ups and downs; Cauchy's weights against slipped flow.
  double tangent = 0, scale = 1, xx = 0;
  for (int iteration = 0; iteration < 20; ++iteration) {
    double xy = 0;
    xx = 0;
    std::vector<double> left;
    for (const Eigen::Vector2d& displacement : displacements) {
      const double residual = displacement.y() - tangent * displacement.x();
      const double weight = 1 / (1 + std::pow(residual / (2.5 * scale), 2));
      xy += weight * displacement.x() * displacement.y();
      xx += weight * displacement.x() * displacement.x();
      left.push_back(std::abs(residual));
    }
    tangent = xy / std::max(xx, 1e-9);
    scale = std::max(kSigmaPerMedian * median(left), 0.02);
  }
  // Sway lasts some frames: five neighbours count as one.
  const double sd = std::max(kLeast, std::sqrt(5.0 / xx) * scale);
  if (sd > kSure) return std::nullopt;
  return Prior{-std::atan(tangent), sd};
}

}  // namespace stride::fit
