#include "calibrate/fit/ground_slope.h"

#include <algorithm>
#include <cmath>

#include "extract/io/statistics.h"
#include "extract/skeleton/robust_fit.h"

namespace stride::fit {

namespace {

/// The direction in which the background passes.
struct Background {
  double tangent = 0;
  double sd = 0;          // of its angle, rad
  double scatter_px = 0;  // of a step, across that direction
};

/// None if the camera stands, or the background passes by less than half a frame.
std::optional<Background> background_of(const Trajectory& trajectory) {
  constexpr double kLeast = 0.005;  // rad
  std::vector<Eigen::Vector2d> displacements;
  Eigen::Vector2d passed = Eigen::Vector2d::Zero();
  for (const TrajectoryFrame& frame : trajectory.frames)
    if (frame.camera_px.allFinite()) {
      displacements.push_back(frame.camera_px);
      passed += frame.camera_px;
    }
  if (displacements.size() < 8 || std::abs(passed.x()) < 0.5 * trajectory.width_px)
    return std::nullopt;
  // y = x tan φ plus vertical camera motion; Cauchy's weights against outliers of the flow.
  Background background;
  double& tangent = background.tangent;
  double scale = 1, xx = 0;
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
  background.scatter_px = scale;
  // Camera sway is correlated over frames: five neighbours count as one.
  background.sd = std::max(kLeast, std::sqrt(5.0 / xx) * scale);
  return background;
}

/// The slope of the runner's path before the background, by least squares; none without a path.
std::optional<double> slope_of_path(const Trajectory& trajectory, const Background& background) {
  constexpr double kSlipped = 5;  // times the scatter: no step of the background
  Eigen::Vector2d camera = Eigen::Vector2d::Zero(), mean = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> path;
  for (const TrajectoryFrame& frame : trajectory.frames) {
    if (frame.camera_px.allFinite()) {
      Eigen::Vector2d step = frame.camera_px;
      const double along = background.tangent * step.x();
      if (std::abs(step.y() - along) > kSlipped * background.scatter_px) step.y() = along;
      camera += step;
    }
    if (!frame[BodyPart::pelvis].present()) continue;
    path.emplace_back(frame[BodyPart::pelvis].p_px - camera);
    mean += path.back();
  }
  if (path.size() < 8) return std::nullopt;
  mean /= static_cast<double>(path.size());
  double xx = 0, xy = 0, least = mean.x(), greatest = mean.x();
  for (const Eigen::Vector2d& p : path) {
    xx += std::pow(p.x() - mean.x(), 2);
    xy += (p.x() - mean.x()) * (p.y() - mean.y());
    least = std::min(least, p.x());
    greatest = std::max(greatest, p.x());
  }
  if (greatest - least < 0.5 * trajectory.width_px) return std::nullopt;
  return xy / xx;
}

/// The angle between the path of the runner and that of the background, rad; 0 without a path.
double disagreement(const Trajectory& trajectory, const Background& background) {
  const auto slope = slope_of_path(trajectory, background);
  return slope ? std::abs(std::atan(*slope) - std::atan(background.tangent)) : 0;
}

bool turns(double disagreement) {
  constexpr double kAgree = 0.021;  // rad; they differ by at most 0.016 on our clips
  return disagreement > kAgree;
}

}  // namespace

std::optional<Prior> ground_roll(const Trajectory& trajectory) {
  constexpr double kLine = 0.01, kSure = 0.017;  // rad
  // Image axes have y down: a floor that falls to the right has a positive slope there.
  if (std::isfinite(trajectory.floor_roll_rad)) return Prior{-trajectory.floor_roll_rad, kLine};
  const auto background = background_of(trajectory);
  if (!background || background->sd > kSure) return std::nullopt;
  // Less than turns() can tell may still be a tilt.
  const double apart = disagreement(trajectory, *background);
  if (turns(apart)) return std::nullopt;
  return Prior{-std::atan(background->tangent), std::hypot(background->sd, apart)};
}

bool camera_turns(const Trajectory& trajectory) {
  const auto background = background_of(trajectory);
  return background && turns(disagreement(trajectory, *background));
}

}  // namespace stride::fit
