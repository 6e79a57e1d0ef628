#include "train/simulation/laws/muscle.h"

#include <algorithm>
#include <cmath>

namespace stride::laws {
namespace {

// Thelen's toe region ends at a third of the maximum force; requiring the slopes to meet there
// gives toe strain and linear stiffness exactly, where the paper prints 0.609 and 1.712.
constexpr double kToeRate = 3, kToeForce = 0.33;

// Thelen's (6): the velocity scale falls to a quarter at no activation.
double velocity_scale(double activation) { return 0.25 + 0.75 * activation; }

}  // namespace

MuscleLaw::MuscleLaw(const osim::Muscle& m)
    : max_force_N(m.max_isometric_force_N),
      optimal_length_m(m.optimal_fiber_length_m),
      tendon_slack_m(m.tendon_slack_length_m),
      max_speed_m_s(m.max_contraction_velocity * m.optimal_fiber_length_m),
      width_m(m.optimal_fiber_length_m * std::sin(m.pennation_angle_at_optimal_rad)),
      minimum_length_m(width_m / std::sin(m.maximum_pennation_angle_rad)),
      cos_max_pennation(width_m > 0 ? std::cos(m.maximum_pennation_angle_rad) : 1),
      tau_activation_s(m.activation_time_constant_s),
      tau_deactivation_s(m.deactivation_time_constant_s),
      minimum_activation(m.minimum_activation),
      active_shape(m.KshapeActive),
      passive_rate(m.KshapePassive / m.FmaxMuscleStrain),
      passive_scale(1 / (std::exp(m.KshapePassive) - 1)),
      toe_strain(99 * m.FmaxTendonStrain * std::exp(kToeRate) / (166 * std::exp(kToeRate) - 67)),
      toe_rate(kToeRate / toe_strain),
      toe_scale(kToeForce / (std::exp(kToeRate) - 1)),
      linear_stiffness(0.67 / (m.FmaxTendonStrain - toe_strain)),
      af(m.Af),
      flen(m.Flen),
      linear_from(m.fv_linear_extrap_threshold) {}

Slope active_force_length(const MuscleLaw& law, double fiber_n) {
  const double d = fiber_n - 1;
  const double value = std::exp(-d * d / law.active_shape);
  return {value, -2 * d / law.active_shape * value};
}

Slope passive_force_length(const MuscleLaw& law, double fiber_n) {
  if (fiber_n <= 1) return {};
  const double e = std::exp(law.passive_rate * (fiber_n - 1));
  return {(e - 1) * law.passive_scale, law.passive_rate * e * law.passive_scale};
}

Slope tendon_force(const MuscleLaw& law, double strain) {
  if (strain <= 0) return {};
  if (strain > law.toe_strain) {
    return {law.linear_stiffness * (strain - law.toe_strain) + kToeForce, law.linear_stiffness};
  }
  const double e = std::exp(law.toe_rate * strain);
  return {law.toe_scale * (e - 1), law.toe_scale * law.toe_rate * e};
}

Slope fiber_speed(const MuscleLaw& law, double activation, double fal, double active_force_n) {
  const double isometric = activation * fal;
  const double straight_from = law.linear_from * law.flen * isometric;
  // Outside the curve: its tangent at the end.
  const double force = std::clamp(active_force_n, 0.0, straight_from);
  double b, db;
  if (force <= isometric) {  // shortening
    b = isometric + force / law.af;
    db = 1 / law.af;
  } else {  // lengthening
    db = -(2 + 2 / law.af) / (law.flen - 1);
    b = -db * (isometric * law.flen - force);
  }
  const double scale = velocity_scale(activation);
  const double slope = scale / b - scale * (force - isometric) / (b * b) * db;
  return {scale * (force - isometric) / b + slope * (active_force_n - force), slope};
}

double force_velocity(const MuscleLaw& law, double activation, double fal, double speed_n) {
  const double isometric = activation * fal;
  for (const double end : {0.0, law.linear_from * law.flen * isometric}) {
    const Slope at_end = fiber_speed(law, activation, fal, end);
    const bool beyond = end > 0 ? speed_n >= at_end.value : speed_n <= at_end.value;
    if (beyond) return (end + (speed_n - at_end.value) / at_end.derivative) / isometric;
  }
  const double scale = velocity_scale(activation);
  if (speed_n <= 0) return (scale + speed_n) / (scale - speed_n / law.af);
  const double k = (2 + 2 / law.af) * speed_n / (law.flen - 1);
  return (scale + k * law.flen) / (scale + k);
}

double cos_pennation(const MuscleLaw& law, double fiber_length_m) {
  if (fiber_length_m <= law.minimum_length_m) return law.cos_max_pennation;
  const double sine = law.width_m / fiber_length_m;
  return std::sqrt(1 - sine * sine);
}

double activation_rate(const MuscleLaw& law, double raw_activation, double excitation) {
  const double a = std::clamp(raw_activation, law.minimum_activation, 1.0);
  const double factor = 0.5 + 1.5 * a;
  return excitation > a ? (excitation - a) / (law.tau_activation_s * factor)
                        : (excitation - a) * factor / law.tau_deactivation_s;
}

MuscleForces muscle_forces(const MuscleLaw& law, double raw_activation, double fiber_length_m,
                           double path_length_m) {
  const double a = std::clamp(raw_activation, law.minimum_activation, 1.0);
  const double length = std::max(fiber_length_m, law.minimum_length_m);
  MuscleForces f;
  f.cos_pennation = cos_pennation(law, length);
  f.tendon_strain = (path_length_m - length * f.cos_pennation) / law.tendon_slack_m - 1;
  f.fal = active_force_length(law, length / law.optimal_length_m).value;
  f.fpe = passive_force_length(law, length / law.optimal_length_m).value;
  const double fse = tendon_force(law, f.tendon_strain).value;
  const double active = fse / f.cos_pennation - f.fpe;
  const double speed = fiber_speed(law, a, f.fal, active).value;
  f.clamped = fiber_length_m <= law.minimum_length_m && speed <= 0;
  f.fv = f.clamped ? 1 : active / (a * f.fal);
  f.fiber_velocity_m_s = f.clamped ? 0 : speed * law.max_speed_m_s;
  f.tendon_force_N = fse * law.max_force_N;
  return f;
}

double equilibrium_fiber_length(const MuscleLaw& law, double raw_activation, double path_length_m) {
  const double a = std::clamp(raw_activation, law.minimum_activation, 1.0);
  // Fibre force minus tendon force, which grows as the tendon slackens.
  const auto excess = [&](double length) {
    const double c = cos_pennation(law, length);
    const double fiber_n = length / law.optimal_length_m;
    const double strain = (path_length_m - length * c) / law.tendon_slack_m - 1;
    return (a * active_force_length(law, fiber_n).value +
            passive_force_length(law, fiber_n).value) *
               c -
           tendon_force(law, strain).value;
  };
  double low = law.minimum_length_m;
  double high = std::hypot(std::max(path_length_m - law.tendon_slack_m, 0.0), law.width_m);
  if (high <= low || excess(low) >= 0) return low;
  // Bisection to the last bit: this is not time-critical, and the curves have corners.
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    (excess(middle) < 0 ? low : high) = middle;
  }
}

}  // namespace stride::laws
