#include "shaping/potential.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "extract/io/error.h"

namespace stride {
namespace {

/// The paper's inverse distances, bounded at d = 0 by ε.
double inverse_distance(InverseDistance function, const Eigen::Vector2d& d, double epsilon) {
  switch (function) {
    case InverseDistance::pf1:
      return 1 / (std::abs(d.x()) + std::abs(d.y()) + epsilon);
    case InverseDistance::pf2:
      return 1 / std::sqrt(d.squaredNorm() + epsilon * epsilon);
    case InverseDistance::pf3:
      return 1 / (d.squaredNorm() + epsilon * epsilon);
  }
  return 0;
}

/// Σ over pelvis, two knees, two feet. The pelvis is the origin of the others, so it is compared by
/// its height.
double closeness(const Potential& potential, const Pose& pose, const Pose& target) {
  const auto of = [&](const Eigen::Vector2d& d) {
    return inverse_distance(potential.function, d, potential.epsilon_m);
  };
  return potential.weight * (of({0, pose.pelvis_height_m - target.pelvis_height_m}) +
                             of(pose.knee_r - target.knee_r) + of(pose.foot_r - target.foot_r) +
                             of(pose.knee_l - target.knee_l) + of(pose.foot_l - target.foot_l));
}

double modulo(double value, double period) { return value - period * std::floor(value / period); }

/// Weights of n equally spaced values in their periodic cubic spline at `position` (in steps).
/// The spline is Σ c_i B(position − i) with (c_{i−1} + 4 c_i + c_{i+1}) / 6 = y_i; the inverse of
/// that circulant matrix is the periodised 6 A λ^|k|, λ = √3 − 2, A = 1 / (2√3).
std::vector<double> periodic_spline_weights(std::size_t n, double position) {
  std::vector<double> power(n + 1, 1.0);  // λ^k
  for (std::size_t k = 1; k <= n; ++k) power[k] = power[k - 1] * (std::numbers::sqrt3 - 2);
  const double scale = std::numbers::sqrt3 / (1 - power[n]);
  position = modulo(position, static_cast<double>(n));
  const auto i = static_cast<std::size_t>(position);
  const double u = position - static_cast<double>(i), v = 1 - u;
  const std::array<double, 4> basis{v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
                                    (3 * v * v * v - 6 * v * v + 4) / 6, u * u * u / 6};
  std::vector<double> weights(n, 0.0);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < basis.size(); ++j) {
      const std::size_t distance = (i + j + 2 * n - 1 - k) % n;
      weights[k] += basis[j] * scale * (power[distance] + power[n - distance]);
    }
  return weights;
}

}  // namespace

Pose Pose::mirrored() const {
  return {.pelvis_height_m = pelvis_height_m,
          .knee_r = knee_l,
          .foot_r = foot_l,
          .knee_l = knee_r,
          .foot_l = foot_r};
}

double Potential::operator()(const Pose& pose, double phase) const {
  if (index == PotentialIndex::time) return closeness(*this, pose, target(phase));
  double nearest = 0;
  for (const Keyframe& keyframe : keyframes)
    nearest = std::max(nearest, closeness(*this, pose, keyframe.pose));
  return nearest;
}

double Potential::phase_at(double time_s) const { return modulo(time_s / period_s, 1.0); }

Pose Potential::target(double phase) const {
  const std::size_t n = keyframes.size();
  const std::vector<double> weights =
      periodic_spline_weights(n, (phase - keyframes.front().phase) * static_cast<double>(n));
  Pose pose;
  for (std::size_t k = 0; k < n; ++k) {
    const Pose& key = keyframes[k].pose;
    pose.pelvis_height_m += weights[k] * key.pelvis_height_m;
    pose.knee_r += weights[k] * key.knee_r;
    pose.foot_r += weights[k] * key.foot_r;
    pose.knee_l += weights[k] * key.knee_l;
    pose.foot_l += weights[k] * key.foot_l;
  }
  return pose;
}

double shaping_reward(double phi, double phi_next, double gamma, bool terminated) {
  return gamma * (terminated ? 0 : phi_next) - phi;
}

std::string_view name(InverseDistance function) {
  constexpr std::array<std::string_view, 3> names{"pf1", "pf2", "pf3"};
  return names[static_cast<std::size_t>(function)];
}

InverseDistance inverse_distance(std::string_view wanted) {
  for (const auto function : {InverseDistance::pf1, InverseDistance::pf2, InverseDistance::pf3})
    if (name(function) == wanted) return function;
  throw Error(fmt::format("function = '{}': must be pf1, pf2 or pf3", wanted));
}

std::string_view name(PotentialIndex index) {
  return index == PotentialIndex::time ? "time" : "nearest";
}

PotentialIndex potential_index(std::string_view wanted) {
  for (const auto index : {PotentialIndex::time, PotentialIndex::nearest})
    if (name(index) == wanted) return index;
  throw Error(fmt::format("index = '{}': must be time or nearest", wanted));
}

}  // namespace stride
