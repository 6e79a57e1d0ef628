#include "extract/tracking/stride_fold.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "extract/io/statistics.h"
#include "extract/skeleton/fourier_series.h"
#include "extract/skeleton/robust_linear_fit.h"

namespace stride::tracking {
namespace {

using Eigen::Vector2d;
using Basis = Eigen::Matrix<double, 10, 1>;

/// Seen from the side both legs swing about the same place. A weight of this share of all points on
/// that halves the distance between the two; without it, legs that are exchanged whenever they pass
/// one another, so that one is always in front, would fit as well.
constexpr double kSidesAlike = 0.25;
constexpr int kMostAlike = 4;  // periods that the spacing of the frames makes alike

/// Offsets of right and left, then cosine and sine of each harmonic.
Basis basis(double time_s, int side, double period_s) {
  Basis b = Basis::Zero();
  b[side] = 1;
  fourier_waves(2 * std::numbers::pi * (time_s / period_s + 0.5 * side), {b.data() + 2, 8});
  return b;
}

constexpr double kShortestOfRunners_s = 0.4;

/// Whether another period can look the same at these times: four of them in the shortest of a
/// runner tell.
bool has_aliases(const std::vector<double>& times_s) {
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < times_s.size(); ++i) steps_s.push_back(times_s[i] - times_s[i - 1]);
  return median(steps_s) > kShortestOfRunners_s / 4;
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
      const RobustLinearFit joint_fit =
          robust_linear_fit(rows, signals, row_weights, 0.5, kSidesAlike * row_weights.sum());
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
  std::vector<StridePeriod> periods =
      stride_periods(joints, times_s, LegNames::unknown, has_aliases(times_s) ? kMostAlike : 1);
  if (periods.empty()) return std::nullopt;
  // Seen slightly from the front or the back the legs differ, and two strides can pass for one.
  // With labels, a wrong factor of two puts the legs in phase, which fits badly, as does a period
  // that is an alias of the frame spacing.
  const StridePeriod best_period = periods.front();
  if (const double half_s = best_period.period_s / 2; half_s >= kShortestOfRunners_s)
    periods.push_back({half_s, best_period.cost - period_improbability(best_period.period_s) +
                                   period_improbability(half_s)});
  std::optional<Folded> best;
  double least = std::numeric_limits<double>::infinity();
  for (const StridePeriod& period : periods)
    if (Folded next = fold_at(joints, times_s, period.period_s);
        period.cost + next.negative_log_likelihood < least) {
      least = period.cost + next.negative_log_likelihood;
      best = std::move(next);
    }
  return best->fold;
}

}  // namespace stride::tracking
