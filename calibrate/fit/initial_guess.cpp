#include "calibrate/fit/initial_guess.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "extract/io/statistics.h"
#include "extract/skeleton/fourier_series.h"
#include "extract/skeleton/robust_linear_fit.h"

namespace stride::fit {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr int kGuessHarmonics = 4;

/// A point relative to the pelvis on the same frame, with its leg.
struct Relative {
  double u_s;
  int side;
  Vector2d d_px;
};

/// Knee, ankle or toe of both legs.
std::vector<Relative> relative_marks(const Marks& all, BodyPart right) {
  std::map<int, Vector2d> pelvis;
  for (const Mark& mark : all.points)
    if (mark.part == BodyPart::pelvis) pelvis[mark.frame] = mark.z_px;
  std::vector<Relative> marks;
  for (const Mark& mark : all.points) {
    if (mark.part != right && mark.part != mirrored(right)) continue;
    const auto origin = pelvis.find(mark.frame);
    if (origin != pelvis.end())
      marks.push_back({mark.u_s, side_of(mark.part), mark.z_px - origin->second});
  }
  return marks;
}

/// Two rows of coefficients, x and y, of the series of one part.
using Curve = Eigen::Matrix<double, Eigen::Dynamic, 2>;

/// The series of a part at a period, right and left half a cycle apart.
Curve fit_curve(const std::vector<Relative>& marks, double period_s, int harmonics) {
  const auto n = static_cast<Eigen::Index>(marks.size());
  MatrixXd rows(n, 2 * harmonics + 1);
  MatrixXd values(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Relative& mark = marks[static_cast<std::size_t>(i)];
    rows.row(i) =
        fourier_basis(mark.u_s / period_s + (mark.side > 0 ? 0 : 0.5), harmonics).transpose();
    values.row(i) = mark.d_px.transpose();
  }
  return robust_linear_fit(rows, values, VectorXd::Ones(n), 1e-9).coefficients;
}

Vector2d at(const Curve& curve, double phase) {
  return curve.transpose() * fourier_basis(phase, static_cast<int>(curve.rows() - 1) / 2);
}

/// Coefficients of a function of phase, sampled finely.
template <typename Function>
FourierSeries<kMaxHarmonics> series_of(Function f, int harmonics) {
  constexpr int kSamples = 64;
  FourierSeries<kMaxHarmonics> series{};
  for (int i = 0; i < kSamples; ++i) {
    const double phase = static_cast<double>(i) / kSamples, value = f(i);
    const VectorXd row = fourier_basis(phase, harmonics);
    for (int k = 0; k < row.size(); ++k)
      series[k] += value * row[k] * (k == 0 ? 1.0 : 2.0) / kSamples;
  }
  return series;
}

/// The angle of a vector against `zero`, ccw, near `previous`.
double angle_near(const Vector2d& v, const Vector2d& zero, double previous) {
  const double angle = std::atan2(zero.x() * v.y() - zero.y() * v.x(), zero.dot(v));
  return angle + 2 * std::numbers::pi * std::round((previous - angle) / (2 * std::numbers::pi));
}

}  // namespace

std::vector<StridePeriod> guess_periods(const Marks& all, int count) {
  const std::size_t frames = all.u_s.size();
  const Vector2d absent = Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  const std::array parts{BodyPart::ankle_r, BodyPart::knee_r};
  std::vector joints(parts.size(), std::vector<JointPair>(frames, {{absent, absent}, {1, 1}}));
  std::vector<Vector2d> pelvis(frames, absent);
  for (const Mark& mark : all.points)
    if (mark.part == BodyPart::pelvis) pelvis[static_cast<std::size_t>(mark.frame)] = mark.z_px;
  for (const Mark& mark : all.points)
    for (std::size_t j = 0; j < parts.size(); ++j)
      if (mark.part == parts[j] || mark.part == mirrored(parts[j])) {
        const auto i = static_cast<std::size_t>(mark.frame);
        joints[j][i].p_px[side_of(mark.part) > 0 ? 0 : 1] = mark.z_px - pelvis[i];
      }
  return stride_periods(joints, all.u_s, LegNames::trusted, count);
}

Runner guess_runner(const Marks& all, const SagittalModel& model, double period_s, double leg_m) {
  constexpr int kSamples = 64;
  const Directions directions(model);
  const Curve knee = fit_curve(relative_marks(all, BodyPart::knee_r), period_s, kGuessHarmonics),
              ankle = fit_curve(relative_marks(all, BodyPart::ankle_r), period_s, kGuessHarmonics);
  const bool toes = all.sees_toes();
  Curve toe = ankle;
  if (toes) toe = fit_curve(relative_marks(all, BodyPart::toe_r), period_s, kGuessHarmonics);

  std::vector<double> thigh_px, shank_px, foot_px, thigh, shank, foot;
  double previous_thigh = 0, previous_shank = -0.7, previous_foot = -0.7;
  for (int i = 0; i < kSamples; ++i) {
    const double phase = static_cast<double>(i) / kSamples;
    const Vector2d k = at(knee, phase), a = at(ankle, phase), t = at(toe, phase);
    thigh_px.push_back(k.norm());
    shank_px.push_back((a - k).norm());
    foot_px.push_back((t - a).norm());
    thigh.push_back(previous_thigh = angle_near(k, {0, -1}, previous_thigh));
    shank.push_back(previous_shank = angle_near(a - k, {0, -1}, previous_shank));
    foot.push_back(previous_foot =
                       toes ? angle_near(t - a, directions.foot, previous_foot) : previous_shank);
  }
  Runner runner;
  const double leg_px = median(thigh_px) + median(shank_px);
  runner.camera[camera::log_px_per_m] = std::log(leg_px / leg_m);
  runner.cadence[cadence::period_s] = period_s;
  runner.body[body::thigh] = leg_m * median(thigh_px) / leg_px;
  runner.body[body::shank] = leg_m * median(shank_px) / leg_px;
  runner.body[body::foot] = toes ? leg_m * median(foot_px) / leg_px : 0.25 * leg_m;
  runner.body[body::trunk] = 0.87 * leg_m;
  runner.hip = series_of([&](int i) { return thigh[i]; }, kGuessHarmonics);
  runner.knee = series_of([&](int i) { return shank[i] - thigh[i]; }, kGuessHarmonics);
  runner.ankle = series_of([&](int i) { return foot[i] - shank[i]; }, kGuessHarmonics);
  return runner;
}

}  // namespace stride::fit
