#pragma once

// C++17-clean and free of Simbody and Eigen.

#include "calibrate/osim/model.h"

namespace stride::laws {

/// The muscle of Thelen (2003, J. Biomech. Eng. 125:70) as implemented in OpenSim 4: a fibre
/// (active and passive) at a pennation angle, in series with an elastic tendon. Its state is the
/// raw activation and the fibre length; the fibre's speed follows from the balance of forces,
/// inverted through the force–velocity curve. Suffix `n`: lengths in optimal fibre lengths, forces
/// in the maximum isometric force, speeds in optimal fibre lengths times the maximum contraction
/// velocity.

/// Constants of a Muscle, computed once.
struct MuscleLaw {
  explicit MuscleLaw(const osim::Muscle& muscle);

  double max_force_N, optimal_length_m, tendon_slack_m, max_speed_m_s;
  double width_m;            // optimal length · sin(pennation at optimum); it never changes
  double minimum_length_m;   // where the pennation angle is largest; 0 for a muscle without one
  double cos_max_pennation;  // at and below that length
  double tau_activation_s, tau_deactivation_s, minimum_activation;
  double active_shape;                 // γ of exp(-(l-1)²/γ)
  double passive_rate, passive_scale;  // (exp(rate·(l-1)) - 1) · scale, l > 1
  double toe_strain, toe_rate, toe_scale, linear_stiffness;  // of the tendon
  double af, flen,
      linear_from;  // force–velocity: shape, eccentric asymptote, where it turns straight
};

/// A value and its derivative by the argument.
struct Slope {
  double value = 0, derivative = 0;
};

Slope active_force_length(const MuscleLaw& law, double fiber_n);
Slope passive_force_length(const MuscleLaw& law, double fiber_n);
/// As a function of the strain l/slack - 1: an exponential toe, then linear; 0 when slack.
Slope tendon_force(const MuscleLaw& law, double strain);

/// The normalised fibre speed at which the active force is `active_force_n` = a·fal·fv (OpenSim's
/// calcdlceN); linear beyond `linear_from` of the eccentric asymptote and below 0. Derivative by
/// active_force_n.
Slope fiber_speed(const MuscleLaw& law, double activation, double fal, double active_force_n);
/// Its inverse: the multiplier fv at a normalised speed.
double force_velocity(const MuscleLaw& law, double activation, double fal, double speed_n);

/// Cosine of the pennation angle, which keeps the fibre's width constant.
double cos_pennation(const MuscleLaw& law, double fiber_length_m);

/// 1/s. The raw activation is clamped to [minimum, 1] but the excitation is not, so below the
/// minimum the raw state decreases without bound.
double activation_rate(const MuscleLaw& law, double raw_activation, double excitation);

struct MuscleForces {
  double tendon_force_N = 0;
  double fiber_velocity_m_s = 0;
  double fal = 0, fpe = 0, fv = 0, cos_pennation = 1, tendon_strain = 0;
  bool clamped = false;  // the fibre is at its minimum length and does not shorten further
};

/// Forces and fibre speed of a state; `path_length_m` is the length of muscle and tendon.
MuscleForces muscle_forces(const MuscleLaw& law, double raw_activation, double fiber_length_m,
                           double path_length_m);

/// The shortest fibre length, m, at which fibre and tendon are in equilibrium with the fibre at
/// rest; the minimum length if the fibre force exceeds the tendon's even there.
double equilibrium_fiber_length(const MuscleLaw& law, double raw_activation, double path_length_m);

}  // namespace stride::laws
