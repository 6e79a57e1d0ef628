#include "calibrate/fit/initial_guess.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "extract/io/statistics.h"
#include "extract/skeleton/fourier_series.h"
#include "extract/skeleton/robust_fit.h"

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

struct CurveFit {
  Curve curve;
  double spread_px = 0;  // median distance of the marks
};

/// Robust linear fit of a part's series at a period: least squares reweighted by Cauchy's weights.
CurveFit fit_curve(const std::vector<Relative>& marks, double period_s, int harmonics) {
  const auto n = static_cast<Eigen::Index>(marks.size());
  MatrixXd rows(n, 2 * harmonics + 1);
  MatrixXd values(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Relative& mark = marks[static_cast<std::size_t>(i)];
    rows.row(i) =
        fourier_basis(mark.u_s / period_s + (mark.side > 0 ? 0 : 0.5), harmonics).transpose();
    values.row(i) = mark.d_px.transpose();
  }
  CurveFit fit;
  const auto weighted_fit = [&](const VectorXd& weights) -> VectorXd {
    const MatrixXd weighted = weights.asDiagonal() * rows;
    MatrixXd normal = rows.transpose() * weighted;
    normal.diagonal().array() += 1e-9 * normal.diagonal().maxCoeff();
    fit.curve = normal.ldlt().solve(weighted.transpose() * values);
    return (values - rows * fit.curve).rowwise().norm();
  };
  fit.spread_px =
      robust_fit(VectorXd::Ones(n), {.rounds = 6, .least_spread = 5e-10}, weighted_fit).spread;
  return fit;
}

/// Median distance of the points from their median, which a period has to explain.
double spread(const std::vector<Relative>& marks) {
  std::vector<double> x, y, distance;
  for (const Relative& mark : marks) {
    x.push_back(mark.d_px.x());
    y.push_back(mark.d_px.y());
  }
  const Vector2d middle(median(x), median(y));
  for (const Relative& mark : marks) distance.push_back((mark.d_px - middle).norm());
  return median(distance);
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

std::vector<PeriodGuess> guess_periods(const Marks& all, int count) {
  const auto ankles = relative_marks(all, BodyPart::ankle_r),
             knees = relative_marks(all, BodyPart::knee_r);
  if (ankles.size() < 12 || knees.size() < 12) return {};
  const double longest = std::min(3.0, all.duration_s), shortest = 0.2;
  if (longest <= shortest) return {};
  const double ankle_spread = spread(ankles), knee_spread = spread(knees);
  const double step = 1 + std::clamp(0.05 * 0.6 / all.duration_s, 0.002, 0.02);
  std::vector<PeriodGuess> tried;
  for (double period = shortest; period <= longest; period *= step) {
    const double left =
        fit_curve(ankles, period, 3).spread_px + fit_curve(knees, period, 3).spread_px;
    const double ratio = left / std::max(ankle_spread + knee_spread, 1e-9);
    tried.push_back({period, 1 - ratio * ratio});
  }
  std::ranges::stable_sort(tried, std::greater{}, &PeriodGuess::explained);
  std::vector<PeriodGuess> best;
  for (const PeriodGuess& guess : tried) {
    const bool is_new = std::ranges::none_of(best, [&](const PeriodGuess& other) {
      return std::abs(std::log(guess.period_s / other.period_s)) < 0.15;
    });
    if (is_new) best.push_back(guess);
    if (static_cast<int>(best.size()) == count) break;
  }
  return best;
}

Runner guess_runner(const Marks& all, const SagittalModel& model, double period_s, double leg_m) {
  constexpr int kSamples = 64;
  const Directions directions(model);
  const Curve knee =
                  fit_curve(relative_marks(all, BodyPart::knee_r), period_s, kGuessHarmonics).curve,
              ankle = fit_curve(relative_marks(all, BodyPart::ankle_r), period_s, kGuessHarmonics)
                          .curve;
  const bool toes = all.sees(BodyPart::toe_r) || all.sees(BodyPart::toe_l);
  Curve toe = ankle;
  if (toes) toe = fit_curve(relative_marks(all, BodyPart::toe_r), period_s, kGuessHarmonics).curve;

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
