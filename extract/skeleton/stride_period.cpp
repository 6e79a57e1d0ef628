#include "extract/skeleton/stride_period.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "extract/io/statistics.h"
#include "extract/skeleton/robust_linear_fit.h"

namespace stride {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr int kHarmonics = 3;
constexpr double kLeastSpread_px = 0.5;
constexpr double kApart = 0.1;    // of candidates, logarithm
constexpr double kWindow_s = 20;  // a longer clip repeats itself, but not that regularly
constexpr std::size_t kLeastFrames = 12;

/// What has to repeat, of one joint: a row an instant.
struct Signals {
  std::vector<double> times_s;
  std::vector<double> lag;   // in periods: half of one for the left leg
  double repeats_every = 1;  // period of the signals in units of the stride's
  MatrixXd values;           // columns: x and y, or five invariants
  VectorXd weights;
};

Signals of_named_legs(const std::vector<JointPair>& joint, const std::vector<double>& times_s) {
  Signals signals;
  std::vector<Vector2d> values;
  std::vector<double> weights;
  for (std::size_t i = 0; i < joint.size(); ++i)
    for (int side = 0; side < 2; ++side) {
      if (!joint[i].p_px[side].allFinite()) continue;
      signals.times_s.push_back(times_s[i]);
      signals.lag.push_back(0.5 * side);
      values.push_back(joint[i].p_px[side]);
      weights.push_back(joint[i].weight[side]);
    }
  const auto n = static_cast<Eigen::Index>(values.size());
  signals.values.resize(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) signals.values.row(i) = values[static_cast<std::size_t>(i)];
  signals.weights = Eigen::Map<const VectorXd>(weights.data(), n);
  return signals;
}

/// What does not change when right and left are exchanged: sum and squared difference of the two
/// sides, which repeat every step.
Signals of_unnamed_legs(const std::vector<JointPair>& joint, const std::vector<double>& times_s) {
  Signals signals;
  signals.repeats_every = 0.5;
  std::vector<Eigen::Matrix<double, 5, 1>> values;
  std::vector<double> weights;
  double squared = 1e-9;
  for (std::size_t i = 0; i < joint.size(); ++i) {
    const Vector2d &r = joint[i].p_px[0], &l = joint[i].p_px[1];
    if (!r.allFinite() || !l.allFinite()) continue;
    const double dx = r.x() - l.x(), dy = r.y() - l.y();
    values.emplace_back();
    values.back() << r.x() + l.x(), r.y() + l.y(), dx * dx - dy * dy, 2 * dx * dy,
        dx * dx + dy * dy;
    weights.push_back(std::min(joint[i].weight[0], joint[i].weight[1]));
    signals.times_s.push_back(times_s[i]);
    signals.lag.push_back(0);
    squared += dx * dx + dy * dy;
  }
  const auto n = static_cast<Eigen::Index>(values.size());
  const double size = std::sqrt(squared / std::max<double>(1, static_cast<double>(n)));
  signals.values.resize(n, 5);
  for (Eigen::Index i = 0; i < n; ++i) {
    signals.values.row(i) = values[static_cast<std::size_t>(i)];
    signals.values.row(i).tail<3>() /= size;
  }
  signals.weights = Eigen::Map<const VectorXd>(weights.data(), n);
  return signals;
}

RobustLinearFit fit_at(const Signals& signals, double period_s) {
  MatrixXd rows(signals.values.rows(), 2 * kHarmonics + 1);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double cycles = signals.times_s[k] / period_s + signals.lag[k];
    rows(i, 0) = 1;
    for (int h = 1; h <= kHarmonics; ++h) {
      const double angle = 2 * std::numbers::pi * h * cycles / signals.repeats_every;
      rows(i, 2 * h - 1) = std::cos(angle);
      rows(i, 2 * h) = std::sin(angle);
    }
  }
  return robust_linear_fit(rows, signals.values, signals.weights, kLeastSpread_px);
}

/// Median distance of the rows from their own median: what a period has to explain.
double spread(const Signals& signals) {
  const auto n = signals.values.rows();
  VectorXd middle(signals.values.cols());
  for (Eigen::Index c = 0; c < middle.size(); ++c) {
    const VectorXd column = signals.values.col(c);
    middle[c] = median({column.data(), column.data() + n});
  }
  const VectorXd distance = (signals.values.rowwise() - middle.transpose()).rowwise().norm();
  return median({distance.data(), distance.data() + n});
}

double explained(const std::vector<Signals>& seen, double period_s) {
  double left = 0, all = 0;
  for (const Signals& signals : seen) {
    left += fit_at(signals, period_s).spread;
    all += spread(signals);
  }
  const double ratio = left / std::max(all, 1e-9);
  return 1 - ratio * ratio;
}

/// First and one behind the last of the instants in the middle of the clip.
std::pair<std::size_t, std::size_t> middle_of(const std::vector<double>& times_s) {
  const double middle_s = 0.5 * (times_s.front() + times_s.back());
  const auto at = [&](double time_s) {
    return static_cast<std::size_t>(std::ranges::lower_bound(times_s, time_s) - times_s.begin());
  };
  return {at(middle_s - kWindow_s / 2), at(middle_s + kWindow_s / 2)};
}

std::vector<StridePeriod> scan(const std::vector<Signals>& seen, const PeriodBounds& bounds,
                               double duration_s) {
  std::vector<StridePeriod> tried;
  for (double period_s = bounds.shortest_s; period_s <= bounds.longest_s;
       // Less than a twentieth of a cycle from the first frame to the last.
       period_s *= 1 + std::clamp(0.05 * period_s / duration_s, 0.002, 0.015)) {
    double cost = period_improbability(period_s);
    for (const Signals& signals : seen) cost += fit_at(signals, period_s).negative_log_likelihood;
    tried.push_back({period_s, cost});
  }
  return tried;
}

}  // namespace

PeriodBounds period_bounds(const std::vector<double>& times_s) {
  constexpr double kLeastSteps = 3, kMostOfClip = 1.1;
  PeriodBounds bounds;
  if (times_s.size() < 2) return bounds;
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < times_s.size(); ++i) steps_s.push_back(times_s[i] - times_s[i - 1]);
  bounds.shortest_s = std::max(bounds.shortest_s, kLeastSteps * median(std::move(steps_s)));
  bounds.longest_s = std::min(bounds.longest_s, kMostOfClip * (times_s.back() - times_s.front()));
  return bounds;
}

double period_improbability(double period_s) {
  constexpr double kUsual_s = 0.75, kUsualSpread = 0.25;  // log-normal
  constexpr double kSlow_s = 2.5, kSlowSpread = 0.6, kSlowShare = 1.0 / 7;
  const auto density = [&](double about_s, double spread) {
    const double z = std::log(period_s / about_s) / spread;
    return std::exp(-0.5 * z * z) / spread;
  };
  const auto mixture = (1 - kSlowShare) * density(kUsual_s, kUsualSpread) +
                       kSlowShare * density(kSlow_s, kSlowSpread);
  return std::log((1 - kSlowShare) / kUsualSpread) - std::log(std::max(mixture, 1e-300));
}

std::vector<StridePeriod> stride_periods(const std::vector<std::vector<JointPair>>& joints,
                                         const std::vector<double>& times_s, LegNames names,
                                         int count) {
  if (times_s.size() < kLeastFrames) return {};
  const auto [begin, end] = middle_of(times_s);
  const auto part = [&, first = begin, last = end](const auto& all) {
    return std::vector(all.begin() + static_cast<long>(first),
                       all.begin() + static_cast<long>(last));
  };
  const std::vector<double> window_s = part(times_s);
  std::vector<Signals> seen;
  for (const std::vector<JointPair>& joint : joints) {
    Signals signals = names == LegNames::trusted ? of_named_legs(part(joint), window_s)
                                                 : of_unnamed_legs(part(joint), window_s);
    if (signals.times_s.size() >= kLeastFrames) seen.push_back(std::move(signals));
  }
  if (seen.empty()) return {};
  const std::vector<StridePeriod> tried =
      scan(seen, period_bounds(window_s), window_s.back() - window_s.front());
  std::vector<StridePeriod> peaks, best;
  for (std::size_t i = 0; i < tried.size(); ++i)
    if ((i == 0 || tried[i].cost <= tried[i - 1].cost) &&
        (i + 1 == tried.size() || tried[i].cost < tried[i + 1].cost))
      peaks.push_back(tried[i]);
  std::ranges::sort(peaks, {}, &StridePeriod::cost);
  for (const StridePeriod& peak : peaks) {
    if (static_cast<int>(best.size()) == count) break;
    if (std::ranges::none_of(best, [&](const StridePeriod& other) {
          return std::abs(std::log(peak.period_s / other.period_s)) < kApart;
        }))
      best.push_back(peak);
  }
  if (names == LegNames::trusted)
    for (StridePeriod& period : best) period.explained = explained(seen, period.period_s);
  return best;
}

}  // namespace stride
