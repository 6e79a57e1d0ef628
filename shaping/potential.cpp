#include "shaping/potential.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "extract/io/error.h"
#include "extract/skeleton/movement.h"

namespace stride {
namespace {

/// The motion of the video at each keyframe; at rest unless velocities are compared.
std::vector<MovingPose> demonstrated(const Potential& potential) {
  std::vector<MovingPose> motions;
  motions.reserve(potential.keyframes.size());
  for (const Keyframe& keyframe : potential.keyframes)
    motions.push_back({keyframe.pose, potential.velocity_s > 0
                                          ? potential.target_velocity(keyframe.phase)
                                          : Pose{}});
  return motions;
}

/// Mean square distance of a part from its mean place over the keyframes, m².
double variance(std::span<const MovingPose> keyframes, const Pose MovingPose::*what,
                PosePart part) {
  const auto n = static_cast<double>(keyframes.size());
  double total = 0;
  for (std::size_t i = 0; i < compared(part).numbers; ++i) {
    double sum = 0, squares = 0;
    for (const MovingPose& each : keyframes) sum += (each.*what).numbers(part)[i];
    for (const MovingPose& each : keyframes)
      squares += std::pow((each.*what).numbers(part)[i] - sum / n, 2);
    total += squares / n;
  }
  return total;
}

/// An angle less another, the shorter way round.
double turn(double angle, double from) {
  return std::remainder(angle - from, 2 * std::numbers::pi);
}

/// Mean square distance of a leg's angle from its mean over the keyframes, rad².
double variance(std::span<const MovingPose> keyframes, std::size_t angle) {
  const auto n = static_cast<double>(keyframes.size());
  const double first = leg_angles(keyframes.front().pose)[angle];
  double mean = 0, squares = 0;  // of the turn from the first
  for (const MovingPose& each : keyframes) mean += turn(leg_angles(each.pose)[angle], first) / n;
  for (const MovingPose& each : keyframes)
    squares += std::pow(turn(leg_angles(each.pose)[angle], first) - mean, 2);
  return squares / n;
}

/// Σ over the angles of the legs.
double closeness_of_angles(const Potential& potential, std::span<const MovingPose> keyframes,
                           const Pose& pose, const Pose& target) {
  const std::array<double, kLegAngles> angles = leg_angles(pose), wanted = leg_angles(target);
  double sum = 0;
  for (std::size_t i = 0; i < kLegAngles; ++i) {
    const double s2 = potential.function == InverseDistance::pf4
                          ? std::pow(potential.angle_m, 2) * variance(keyframes, i)
                          : 0;
    const Eigen::Matrix<double, 1, 1> d(potential.angle_m * turn(angles[i], wanted[i]));
    sum += inverse_distance(potential.function, d, potential.epsilon_m, s2);
  }
  return sum;
}

/// Σ over pelvis, two knees, two feet. The pelvis is the origin of the others, so it is compared by
/// its height.
double closeness(const Potential& potential, std::span<const MovingPose> keyframes,
                 const MovingPose& motion, const MovingPose& target) {
  const bool by_variance = potential.function == InverseDistance::pf4;
  const double velocity_s = potential.velocity_s;
  double sum = 0;
  for (const ComparedPart& each : kPoseParts) {
    double s2 = by_variance ? variance(keyframes, &MovingPose::pose, each.part) : 0;
    const Eigen::Vector2d place = displacement(target.pose, motion.pose, each.part);
    if (velocity_s == 0) {
      sum += inverse_distance(potential.function, place, potential.epsilon_m, s2);
      continue;
    }
    if (by_variance)
      s2 += velocity_s * velocity_s * variance(keyframes, &MovingPose::velocity, each.part);
    Eigen::Vector4d d;
    d << place, velocity_s * displacement(target.velocity, motion.velocity, each.part);
    sum += inverse_distance(potential.function, d, potential.epsilon_m, s2);
  }
  if (potential.angle_m > 0)
    sum += closeness_of_angles(potential, keyframes, motion.pose, target.pose);
  return potential.weight * sum;
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

/// Values at equally spaced knots, as the weights of their cubic spline at `position` (in steps)
/// whose slope is 0 at both ends. The slopes s of the knots between solve
/// s_{i−1} + 4 s_i + s_{i+1} = 3 (y_{i+1} − y_{i−1}); one value after another is y.
std::vector<double> resting_spline_weights(std::size_t n, double position) {
  position = std::clamp(position, 0.0, static_cast<double>(n - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(position), n - 2);
  const double u = position - static_cast<double>(i), v = 1 - u;
  std::vector<double> weights(n, 0.0), ratio(n, 0.0), slope(n);
  for (std::size_t k = 1; k + 1 < n; ++k) ratio[k] = 1 / (4 - ratio[k - 1]);  // Thomas
  weights[i] = v * v * (1 + 2 * u);
  weights[i + 1] = u * u * (1 + 2 * v);
  for (std::size_t y = 0; y < n; ++y) {
    slope.assign(n, 0.0);
    for (std::size_t k = 1; k + 1 < n; ++k)
      slope[k] = ratio[k] * (3.0 * (k + 1 == y) - 3.0 * (k == y + 1) - slope[k - 1]);
    for (std::size_t k = n - 2; k > 0; --k) slope[k] -= ratio[k] * slope[k + 1];
    weights[y] += u * v * v * slope[i] - u * u * v * slope[i + 1];
  }
  return weights;
}

}  // namespace

double Potential::operator()(const Pose& pose, double phase) const {
  require(velocity_s == 0, "potential: velocities are compared: a pose alone has none");
  return (*this)(MovingPose{pose, {}}, phase);
}

double Potential::operator()(const MovingPose& motion, double phase) const {
  std::vector<MovingPose> motions;
  if (index == PotentialIndex::nearest || function == InverseDistance::pf4)
    motions = demonstrated(*this);
  if (index == PotentialIndex::time)
    return closeness(*this, motions, motion,
                     {target(phase), velocity_s > 0 ? target_velocity(phase) : Pose{}});
  double nearest = -std::numeric_limits<double>::infinity();
  for (const MovingPose& each : motions)
    nearest = std::max(nearest, closeness(*this, motions, motion, each));
  return nearest;
}

double Potential::phase_at(double time_s) const {
  const double phase = time_s / period_s;
  return repeats ? modulo(phase, 1.0) : std::clamp(phase, 0.0, 1.0);
}

Pose Potential::target(double phase) const {
  const std::size_t n = keyframes.size();
  const std::vector<double> weights =
      repeats
          ? periodic_spline_weights(n, (phase - keyframes.front().phase) * static_cast<double>(n))
          : resting_spline_weights(n, phase * static_cast<double>(n - 1));
  Pose pose;
  for (std::size_t k = 0; k < n; ++k) {
    const Pose& key = keyframes[k].pose;
    for (std::size_t i = 0; i < kPoseNumbers; ++i) pose.m[i] += weights[k] * key.m[i];
  }
  return pose;
}

Pose Potential::target_velocity(double phase) const {
  constexpr double kStep = 1e-3;  // of the stride
  const Pose before = target(phase - kStep), after = target(phase + kStep);
  Pose velocity;
  for (std::size_t i = 0; i < kPoseNumbers; ++i)
    velocity.m[i] = (after.m[i] - before.m[i]) / (2 * kStep * period_s);
  return velocity;
}

double Potential::contrast() const {
  double in_step = 0, anywhere = 0;
  const std::vector<MovingPose> motions = demonstrated(*this);
  const auto n = static_cast<double>(motions.size());
  for (const MovingPose& one : motions) {
    in_step += closeness(*this, motions, one, one) / n;
    for (const MovingPose& other : motions)
      anywhere += closeness(*this, motions, other, one) / (n * n);
  }
  return in_step - anywhere;
}

void set_movement(Potential& potential, std::string_view name, std::string_view what) {
  const Movement& known = movement(name, what);
  potential.movement = known.name;
  potential.repeats = known.repeats;
  potential.mirrored_after = known.legs == Legs::in_turn ? 0.5 : 0;
}

InverseDistance inverse_distance(std::string_view name) {
  const auto found = kInverseDistances.find(name);
  require(found.has_value(), "function = '{}': must be {}", name, kInverseDistances.list(" or "));
  return *found;
}

PotentialIndex potential_index(std::string_view name) {
  const auto found = kPotentialIndices.find(name);
  require(found.has_value(), "index = '{}': must be {}", name, kPotentialIndices.list(" or "));
  return *found;
}

}  // namespace stride
