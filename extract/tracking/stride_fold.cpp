#include "extract/tracking/stride_fold.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "extract/io/statistics.h"
#include "extract/skeleton/fourier_series.h"
#include "extract/skeleton/robust_fit.h"

namespace stride::tracking {
namespace {

using Eigen::Vector2d;
using Basis = Eigen::Matrix<double, 10, 1>;

constexpr double kShortest_s = 0.4, kLongest_s = 1.7, kScanStep = 1.01;
constexpr double kUsual_s = 0.75, kSpread = 0.35;  // of periods, log-normal
constexpr int kReweightings = 4;
/// Seen from the side both legs swing about the same place. A weight of this share of all points on
/// that halves the distance between the two; without it, legs that are exchanged whenever they pass
/// one another, so that one is always in front, would fit as well.
constexpr double kSidesAlike = 0.25;
constexpr std::size_t kMostPeaks = 4;  // of periods that are alike

/// Offsets of right and left, then cosine and sine of each harmonic.
Basis basis(double time_s, int side, double period_s) {
  Basis b = Basis::Zero();
  b[side] = 1;
  fourier_waves(2 * std::numbers::pi * (time_s / period_s + 0.5 * side), {b.data() + 2, 8});
  return b;
}

/// Robust least squares of several signals over the same rows, by Cauchy weights. `sides_alike`
/// weighs the squared difference of the first two coefficients.
struct Fit {
  Eigen::MatrixXd coefficients;        // a column a signal
  double spread = 0;                   // median distance
  double negative_log_likelihood = 0;  // −log likelihood without constants
};
Fit fit(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& signals, const Eigen::VectorXd& weights,
        double least_spread, double sides_alike = 0) {
  Fit fit;
  const auto weighted_fit = [&](const Eigen::VectorXd& w) -> Eigen::VectorXd {
    Eigen::MatrixXd normal = rows.transpose() * w.asDiagonal() * rows;
    normal.diagonal().array() += 1e-3;
    normal.topLeftCorner<2, 2>() += sides_alike * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
    fit.coefficients = normal.llt().solve(rows.transpose() * w.asDiagonal() * signals);
    return (signals - rows * fit.coefficients).rowwise().norm();
  };
  const RobustFit robust =
      robust_fit(weights, {.rounds = kReweightings, .least_spread = least_spread}, weighted_fit);
  fit.spread = robust.spread;
  fit.negative_log_likelihood =
      (weights.array() *
       (std::log(fit.spread) + (robust.distances / (2 * fit.spread)).array().square().log1p()))
          .sum();
  return fit;
}

/// −log prior probability of a period.
double improbability(double period_s) {
  return 0.5 * std::pow(std::log(period_s / kUsual_s) / kSpread, 2);
}

/// Invariants under swapping right and left, with the period of a step: sum and squared difference
/// of both sides. A row for each frame on which both were seen.
struct Invariants {
  std::vector<double> times_s;
  Eigen::MatrixXd signals;
  Eigen::VectorXd weights;
};
Invariants invariants(const std::vector<JointPair>& joint, const std::vector<double>& times_s) {
  Invariants result;
  std::vector<Eigen::Matrix<double, 5, 1>> rows;
  std::vector<double> weights;
  double squared = 1e-9;
  for (std::size_t i = 0; i < joint.size(); ++i) {
    const Vector2d &r = joint[i].p_px[0], &l = joint[i].p_px[1];
    if (!r.allFinite() || !l.allFinite()) continue;
    const double dx = r.x() - l.x(), dy = r.y() - l.y();
    Eigen::Matrix<double, 5, 1> row;
    row << r.x() + l.x(), r.y() + l.y(), dx * dx - dy * dy, 2 * dx * dy, dx * dx + dy * dy;
    rows.push_back(row);
    weights.push_back(std::min(joint[i].weight[0], joint[i].weight[1]));
    result.times_s.push_back(times_s[i]);
    squared += dx * dx + dy * dy;
  }
  const double size = std::sqrt(squared / std::max<double>(1, static_cast<double>(rows.size())));
  result.signals.resize(static_cast<Eigen::Index>(rows.size()), 5);
  result.weights.resize(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].tail<3>() /= size;
    result.signals.row(static_cast<Eigen::Index>(i)) = rows[i];
    result.weights[static_cast<Eigen::Index>(i)] = weights[i];
  }
  return result;
}

struct Period {
  double period_s, cost;  // −log probability of the invariants
};

/// Whether the sampling times allow aliases of a period: four samples in the shortest period
/// exclude them.
bool has_aliases(const std::vector<double>& times_s) {
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < times_s.size(); ++i) steps_s.push_back(times_s[i] - times_s[i - 1]);
  return median(steps_s) > kShortest_s / 4;
}

/// The period that explains the invariants best, or several if it has aliases; none if the clip is
/// too short.
std::vector<Period> likely_periods(const std::vector<std::vector<JointPair>>& joints,
                                   const std::vector<double>& times_s) {
  std::vector<Invariants> seen;
  for (const auto& joint : joints)
    if (Invariants one = invariants(joint, times_s); one.times_s.size() >= 12)
      seen.push_back(std::move(one));
  if (seen.empty()) return {};
  const double longest_s = std::min(kLongest_s, times_s.back() - times_s.front());
  std::vector<Period> scan, peaks;
  for (double period_s = kShortest_s; period_s <= longest_s; period_s *= kScanStep) {
    double cost = improbability(period_s);
    for (const Invariants& one : seen) {
      Eigen::MatrixXd rows(one.signals.rows(), 7);
      for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        Eigen::Matrix<double, 7, 1> row = Eigen::Matrix<double, 7, 1>::Ones();
        fourier_waves(4 * std::numbers::pi * one.times_s[static_cast<std::size_t>(i)] / period_s,
                      {row.data() + 1, 6});
        rows.row(i) = row;
      }
      cost += fit(rows, one.signals, one.weights, 0.5).negative_log_likelihood;
    }
    scan.push_back({period_s, cost});
  }
  for (std::size_t i = 0; i < scan.size(); ++i)
    if ((i == 0 || scan[i].cost <= scan[i - 1].cost) &&
        (i + 1 == scan.size() || scan[i].cost < scan[i + 1].cost))
      peaks.push_back(scan[i]);
  std::ranges::sort(peaks, {}, &Period::cost);
  peaks.resize(std::min(peaks.size(), has_aliases(times_s) ? kMostPeaks : 1));
  return peaks;
}

}  // namespace

Vector2d StrideFold::place(std::size_t joint, int side, double time_s) const {
  const Basis b = basis(time_s, side, period_s);
  return {b.dot(joints[joint][0]), b.dot(joints[joint][1])};
}

namespace {

struct Folded {
  StrideFold fold;
  double negative_log_likelihood = 0;
};
Folded fold_at(const std::vector<std::vector<JointPair>>& joints,
               const std::vector<double>& times_s, double period_s) {
  Folded result;
  result.fold.period_s = period_s;
  for (const auto& joint : joints) {
    std::vector<Basis> bases;
    std::vector<Vector2d> points;
    std::vector<double> weights;
    for (std::size_t i = 0; i < joint.size(); ++i)
      for (int side = 0; side < 2; ++side)
        if (joint[i].p_px[side].allFinite()) {
          bases.push_back(basis(times_s[i], side, period_s));
          points.push_back(joint[i].p_px[side]);
          weights.push_back(joint[i].weight[side]);
        }
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd rows(n, 10), signals(n, 2);
    Eigen::VectorXd row_weights(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      rows.row(i) = bases[static_cast<std::size_t>(i)];
      signals.row(i) = points[static_cast<std::size_t>(i)];
      row_weights[i] = weights[static_cast<std::size_t>(i)];
    }
    std::array<Basis, 2> coefficients{Basis::Zero(), Basis::Zero()};
    double spread_px = std::numeric_limits<double>::infinity();  // no information if unseen
    if (n > 0) {
      const Fit joint_fit = fit(rows, signals, row_weights, 0.5, kSidesAlike * row_weights.sum());
      coefficients = {joint_fit.coefficients.col(0), joint_fit.coefficients.col(1)};
      spread_px = joint_fit.spread;
      result.negative_log_likelihood += joint_fit.negative_log_likelihood;
    }
    result.fold.joints.push_back(coefficients);
    result.fold.spread_px.push_back(spread_px);
  }
  return result;
}

}  // namespace

std::optional<StrideFold> fold_stride(const std::vector<std::vector<JointPair>>& joints,
                                      const std::vector<double>& times_s) {
  if (times_s.size() < 12) return std::nullopt;
  std::vector<Period> periods = likely_periods(joints, times_s);
  if (periods.empty()) return std::nullopt;
  // Seen slightly from the front or the back the legs differ, and two strides can pass for one.
  // With labels, a wrong factor of two puts the legs in phase, which fits badly, as does a period
  // that is an alias of the frame spacing.
  if (const auto [period_s, cost] = periods.front(); period_s / 2 >= kShortest_s)
    periods.push_back({period_s / 2, cost});
  std::optional<Folded> best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto [period_s, cost] : periods)
    if (Folded next = fold_at(joints, times_s, period_s);
        cost + next.negative_log_likelihood < least) {
      least = cost + next.negative_log_likelihood;
      best = std::move(next);
    }
  return best->fold;
}

}  // namespace stride::tracking
