#include "calibrate/fit/ground_slope.h"

#include <algorithm>
#include <cmath>

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
  const auto n = static_cast<Eigen::Index>(displacements.size());
  double tangent = 0, xx = 0;
  const auto weighted_fit = [&](const Eigen::VectorXd& weights) {
    double xy = 0;
    xx = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Vector2d& displacement = displacements[static_cast<std::size_t>(i)];
      xy += weights[i] * displacement.x() * displacement.y();
      xx += weights[i] * displacement.x() * displacement.x();
    }
    tangent = xy / std::max(xx, 1e-9);
    Eigen::VectorXd distances(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Vector2d& displacement = displacements[static_cast<std::size_t>(i)];
      distances[i] = std::abs(displacement.y() - tangent * displacement.x());
    }
    return distances;
  };
  const RobustOptions options{
      .rounds = 20, .spread_per_median = kSigmaPerMedian, .least_spread = 0.02, .width = 2.5};
  const double scale = robust_fit(Eigen::VectorXd::Ones(n), options, weighted_fit).spread;
  // Sway lasts some frames: five neighbours count as one.
  const double sd = std::max(kLeast, std::sqrt(5.0 / xx) * scale);
  if (sd > kSure) return std::nullopt;
  return Prior{-std::atan(tangent), sd};
}

}  // namespace stride::fit
