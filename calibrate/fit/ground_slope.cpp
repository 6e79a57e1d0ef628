#include "calibrate/fit/ground_slope.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/fit/initial_guess.h"
#include "extract/io/statistics.h"
#include "extract/skeleton/robust_fit.h"

namespace stride::fit {
namespace {

using Eigen::Vector2d;

constexpr int kAlike = 5;  // neighbouring frames, whose errors are one: sway lasts some frames

/// The runner's way past the background. A camera that turns or tilts moves both in the image, so
/// that their difference is along the ground.
struct Way {
  std::vector<double> u_s;
  std::vector<Vector2d> runner_px;      // summed up, past the background
  std::vector<Vector2d> background_px;  // steps, past the frame
  double passed_px = 0;                 // by the background
};

Way way_of(const Trajectory& trajectory) {
  Way way;
  Vector2d at = Vector2d::Zero();
  for (std::size_t i = 1; i < trajectory.frames.size(); ++i) {
    const TrajectoryFrame &before = trajectory.frames[i - 1], &now = trajectory.frames[i];
    const Point &p = before[BodyPart::pelvis], &q = now[BodyPart::pelvis];
    if (!now.camera_px.allFinite()) continue;
    way.passed_px += now.camera_px.x();
    way.background_px.push_back(now.camera_px);
    if (!p.present() || !q.present()) continue;
    at += q.p_px - p.p_px - now.camera_px;
    way.u_s.push_back(now.time_s);
    way.runner_px.push_back(at);
  }
  return way;
}

struct Slope {
  double rad = 0, sd = 0;  // in the image, whose y is down
};

/// y by x, robustly, beside what repeats every step where a period is known.
Slope slope_of(const std::vector<Vector2d>& path, const std::vector<double>& times_s,
               double period_s) {
  const auto n = static_cast<Eigen::Index>(path.size());
  const Eigen::Index columns = period_s > 0 ? 6 : 2;
  Eigen::MatrixXd rows(n, columns);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    rows(i, 0) = path[k].x();
    rows(i, 1) = 1;
    y[i] = path[k].y();
    for (int h = 1; columns == 6 && h <= 2; ++h) {
      const double angle = 4 * std::numbers::pi * h * times_s[k] / period_s;
      rows(i, 2 * h) = std::cos(angle);
      rows(i, 2 * h + 1) = std::sin(angle);
    }
  }
  Eigen::VectorXd solution;
  Eigen::MatrixXd normal;
  const auto weighted_fit = [&](const Eigen::VectorXd& weights) -> Eigen::VectorXd {
    normal = rows.transpose() * weights.asDiagonal() * rows;
    solution = normal.ldlt().solve(rows.transpose() * weights.asDiagonal() * y);
    return (y - rows * solution).cwiseAbs();
  };
  const double scale =
      robust_fit(
          Eigen::VectorXd::Ones(n),
          {.rounds = 8, .spread_per_median = kSigmaPerMedian, .least_spread = 0.02, .width = 2.5},
          weighted_fit)
          .spread;
  const double variance = normal.inverse()(0, 0) * scale * scale * kAlike;
  return {std::atan(solution[0]), std::sqrt(std::max(variance, 0.0))};
}

/// How much larger the runner becomes, logarithm: the camera zooms, or the way leads towards it.
double growth(const Trajectory& trajectory) {
  const std::size_t third = trajectory.frames.size() / 3;
  const auto size_px = [&](std::size_t from, std::size_t to) {
    std::vector<double> shanks;
    for (std::size_t i = from; i < to; ++i)
      for (const auto& [a, b] : {std::pair{BodyPart::knee_r, BodyPart::ankle_r},
                                 std::pair{BodyPart::knee_l, BodyPart::ankle_l}}) {
        const Point &knee = trajectory.frames[i][a], &ankle = trajectory.frames[i][b];
        if (knee.present() && ankle.present()) shanks.push_back((knee.p_px - ankle.p_px).norm());
      }
    return median(std::move(shanks));
  };
  const double ratio =
      size_px(trajectory.frames.size() - third, trajectory.frames.size()) / size_px(0, third);
  return std::isfinite(ratio) && ratio > 0 ? 1.5 * std::log(ratio) : 0;  // of the whole clip
}

}  // namespace

std::optional<Prior> ground_roll(const Trajectory& trajectory) {
  constexpr double kLine = 0.01, kLeast = 0.005, kSure = 0.025;  // rad
  // Image axes have y down: a floor that falls to the right has a positive slope there.
  if (std::isfinite(trajectory.floor_roll_rad)) return Prior{-trajectory.floor_roll_rad, kLine};
  const Way way = way_of(trajectory);
  if (way.runner_px.size() < 12 || std::abs(way.passed_px) < 0.5 * trajectory.width_px)
    return std::nullopt;
  const auto periods = guess_periods(observe(trajectory, false), 1);
  const double period_s = periods.empty() ? 0 : periods.front().period_s;
  const Slope runner = slope_of(way.runner_px, way.u_s, period_s);

  // Were the camera to go along without tilting, the background would pass in the same direction.
  std::vector<Vector2d> passed{Vector2d::Zero()};
  for (const Vector2d& step : way.background_px) passed.push_back(passed.back() + step);
  const Slope background = slope_of(passed, {}, 0);
  // What grows moves away from the horizon, whose height in the picture is not known.
  double off_px = 0, length_px = 0;
  for (const Vector2d& p : way.runner_px) length_px = std::max(length_px, std::abs(p.x()));
  for (const TrajectoryFrame& frame : trajectory.frames)
    if (frame[BodyPart::ankle_r].present())
      off_px = std::max(off_px,
                        std::abs(frame[BodyPart::ankle_r].p_px.y() - 0.5 * trajectory.height_px));
  const double zoom = growth(trajectory) * off_px / std::max(length_px, 1.0);
  const double tilt = 0.5 * (runner.rad - background.rad);
  const double sd = std::hypot(std::hypot(kLeast, runner.sd), std::hypot(tilt, zoom));
  if (sd > kSure) return std::nullopt;
  return Prior{-runner.rad, sd};
}

}  // namespace stride::fit
