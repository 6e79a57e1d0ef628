#include "extract/tracking/gaussian_process/hyperparameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "extract/io/statistics.h"
#include "extract/tracking/gaussian_process/regression.h"

namespace stride::gaussian_process {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Joints that were clicked on the same frames share a covariance matrix.
bool same_times(const GroupData& a, const GroupData& b) {
  return std::ranges::equal(a.samples, b.samples, [](const Sample& s, const Sample& t) {
    return s.time_s == t.time_s && s.left == t.left;
  });
}

/// −log likelihood of the samples without constants.
double negative_log_likelihood(const GaitKernel& kernel, const std::vector<GroupData>& groups) {
  double sum = 0;
  std::array<MatrixXd, 2> matrices;
  const GroupData* before = nullptr;
  for (const GroupData& data : groups) {
    if (before == nullptr || !same_times(*before, data))
      matrices = covariance_matrices(kernel, data);
    before = &data;
    for (int axis = 0; axis < 2; ++axis) {
      MatrixXd noisy = matrices[axis];
      noisy.diagonal().array() += std::pow(kernel.noise_px / data.scale_px[axis], 2) +
                                  kJitter * noisy.diagonal().maxCoeff();
      const Eigen::LLT<MatrixXd> factor(noisy);
      if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
      const VectorXd white = factor.matrixL().solve(coordinate(data, axis));
      const auto lower = factor.matrixLLT().diagonal();
      sum += 0.5 * white.squaredNorm() + lower.array().log().sum();
    }
  }
  return sum;
}

/// A hyperparameter: its log-normal prior for legs and trunk, and its bounds.
struct Expected {
  double value, spread;
};
struct Hyperparameter {
  double GaitKernel::*member;
  Expected legs, trunk;
  double low, high;
};
constexpr std::array kHyperparameters{
    Hyperparameter{&GaitKernel::period_s, {0.75, 0.25}, {0.75, 0.25}, 0.4, 2.2},
    Hyperparameter{&GaitKernel::amplitude, {1, 1}, {1, 0.4}, 0.02, 20},
    Hyperparameter{&GaitKernel::length_scale, {0.75, 0.25}, {1.0, 0.3}, 0.2, 2},
    Hyperparameter{&GaitKernel::coherence_strides, {20, 1}, {20, 1}, 1, 100},
    Hyperparameter{&GaitKernel::asymmetry, {0.2, 0.7}, {0.2, 0.7}, 0.01, 1},
    Hyperparameter{&GaitKernel::residual, {0.1, 1}, {0.5, 1}, 0.01, 20},
    Hyperparameter{&GaitKernel::residual_strides, {0.15, 0.3}, {0.15, 0.3}, 0.05, 0.6},
    Hyperparameter{&GaitKernel::noise_px, {0.7, 0.7}, {0.7, 0.7}, 0.05, 20}};

/// Median time between clicks of one side. A stride with hardly more than one click is ambiguous.
double median_spacing_s(const std::vector<Sample>& samples) {
  std::vector<double> spacings;
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (samples[i].left == samples[i - 1].left)
      spacings.push_back(samples[i].time_s - samples[i - 1].time_s);
  return spacings.empty() ? 0 : median(std::move(spacings));
}

/// −log prior of the feet's direction of circulation: they move backwards low and forwards high. An
/// alias that reverses time circulates the other way.
double backwards_cost(const GaitKernel& kernel, const std::vector<GroupData>& groups, int facing) {
  constexpr int kPhases = 16;
  constexpr double kCost = 15, kUsualArea = 0.1;  // area in units of the squared size of the motion
  for (const GroupData& data : groups) {
    if (facing == 0 || data.group.right != BodyPart::ankle_r) continue;
    GroupData clicks = data;
    for (Sample& s : clicks.samples) s.variance_px2.setConstant(std::pow(kernel.noise_px, 2));
    const Regression regression(kernel, std::move(clicks));
    std::vector<double> times_s;
    for (int i = 0; i <= kPhases; ++i) times_s.push_back(kernel.period_s * i / kPhases);
    double area = 0;
    for (int left = 0; left < 2; ++left) {
      const std::vector<Eigen::Vector2d> px = regression.places(times_s, left);
      for (std::size_t i = 0; i < kPhases; ++i)
        area += (px[i].x() * px[i + 1].y() - px[i].y() * px[i + 1].x()) / 4;
    }
    area /= data.scale_px.prod();
    return kCost * std::clamp(-facing * area / kUsualArea, 0.0, 1.0);
  }
  return 0;
}

}  // namespace

double improbability(const GaitKernel& kernel, bool legs) {
  double sum = 0;
  for (const Hyperparameter& h : kHyperparameters) {
    const double value = kernel.*h.member;
    if (value < h.low || value > h.high) return std::numeric_limits<double>::infinity();
    const Expected& expected = legs ? h.legs : h.trunk;
    sum += 0.5 * std::pow(std::log(value / expected.value) / expected.spread, 2);
  }
  return sum;
}

double cost(const GaitKernel& kernel, const std::vector<GroupData>& groups) {
  const double sum = improbability(kernel, /*legs=*/true);
  return std::isfinite(sum) ? sum + negative_log_likelihood(kernel, groups) : sum;
}

Fitted refined(Fitted best, const std::vector<GroupData>& groups, int rounds) {
  double step = 1.8;
  for (int round = 0; round < rounds; ++round, step = std::sqrt(step))
    for (const Hyperparameter& h : kHyperparameters) {
      const bool is_period = h.member == &GaitKernel::period_s;
      if (h.member == &GaitKernel::amplitude) continue;  // of the trunk
      descend(
          best, best.cost, is_period ? 1 + 0.02 * (step - 1) : step, 3,
          [&](Fitted& next, double factor) { next.kernel.*h.member *= factor; },
          [&](const Fitted& next) { return cost(next.kernel, groups); });
    }
  return best;
}

Fitted fitted(const std::vector<GroupData>& groups, int facing) {
  std::vector<Fitted> scan;
  const double shortest_s = std::clamp(1.6 * median_spacing_s(groups.front().samples), 0.4, 1.2);
  for (double period_s = shortest_s; period_s < 1.7; period_s *= 1.015) {
    GaitKernel kernel;
    kernel.period_s = period_s;
    scan.push_back({kernel, cost(kernel, groups)});
  }
  std::vector<Fitted> peaks;
  for (std::size_t i = 0; i < scan.size(); ++i)
    if ((i == 0 || scan[i].cost <= scan[i - 1].cost) &&
        (i + 1 == scan.size() || scan[i].cost < scan[i + 1].cost))
      peaks.push_back(scan[i]);
  const auto keep = [&](std::size_t most, auto&& cost_of) {
    std::ranges::sort(peaks, {}, cost_of);
    if (peaks.size() > most) peaks.resize(most);
  };
  const auto total = [&](const Fitted& peak) {
    return peak.cost + backwards_cost(peak.kernel, groups, facing);
  };
  keep(6, [](const Fitted& peak) { return peak.cost; });
  for (Fitted& peak : peaks) peak = refined(peak, groups, 1);
  keep(2, total);
  for (Fitted& peak : peaks) peak = refined(peak, groups, 4);
  keep(1, total);
  return peaks.front();
}

}  // namespace stride::gaussian_process
