#pragma once

// C++17-clean and free of Simbody and Eigen.

#include <algorithm>
#include <cmath>

#include "calibrate/osim/model.h"

namespace stride::laws {

/// Contact of a sphere with the ground or with another sphere: Hertz's spring with the damping of
/// Hunt and Crossley and the regularised friction of Simbody's HuntCrossleyForce, both bodies of
/// one material. The force acts half-way in depth, along the line of centres.
struct ContactLaw {
  double plane_strain_modulus = 0;  // k = ½ stiffness^(2/3), N^(2/3)·m^(-4/3)
  double dissipation = 0;           // s/m
  double static_friction = 0, dynamic_friction = 0, viscous_friction = 0;
  double transition_velocity_m_s = 0.01;
};

inline ContactLaw contact_law(const osim::ContactForce& force) {
  return {0.5 * std::pow(force.stiffness, 2.0 / 3),
          force.dissipation,
          force.static_friction,
          force.dynamic_friction,
          force.viscous_friction,
          force.transition_velocity_m_s};
}

/// The force that pushes apart, N; negative where damping would pull: then there is none, neither
/// normal nor friction. `radius_m` is the sphere's, or r₁r₂/(r₁+r₂) between two spheres.
inline double normal_force(const ContactLaw& law, double radius_m, double depth_m,
                           double approach_m_s) {
  if (depth_m <= 0) return 0;
  const double kx = law.plane_strain_modulus * depth_m;
  const double hertz = 4.0 / 3 * kx * std::sqrt(radius_m * kx);
  return hertz * (1 + 1.5 * law.dissipation * approach_m_s);
}

/// The force against a slip of speed `slip_m_s` ≥ 0, N; linear below the transition velocity, so
/// nothing ever sticks.
inline double friction_force(const ContactLaw& law, double normal_N, double slip_m_s) {
  const double v = slip_m_s / law.transition_velocity_m_s;
  const double us = law.static_friction, ud = law.dynamic_friction;
  return normal_N *
         (std::min(v, 1.0) * (ud + 2 * (us - ud) / (1 + v * v)) + law.viscous_friction * slip_m_s);
}

/// Simbody's HuntCrossleyForce stops at the first contact of its element whose force is not
/// positive and drops those that follow (O2). They follow in the order of Simbody's sweep: along
/// that axis on which the plane's origin and the centres of the spheres vary most. True if the
/// first of a foot's two spheres comes first; centres in the ground, m.
inline bool first_sphere_is_swept_first(const osim::Vec3& first, double first_radius_m,
                                        const osim::Vec3& second, double second_radius_m) {
  const auto variation = [&](int axis) {
    const double mean = (first[axis] + second[axis]) / 3;  // the plane's origin is the ground's
    return std::abs(mean) + std::abs(first[axis] - mean) + std::abs(second[axis] - mean);
  };
  int axis = variation(0) > variation(1) ? 0 : 1;
  if (variation(2) > variation(axis)) axis = 2;
  return first[axis] - first_radius_m <= second[axis] - second_radius_m;
}

/// Obstacles of "Learning to Run": frictionless, of stiffness 1e6/r with the radius that the file
/// of the competition's environment names; but there every one collides as a sphere of 0.1 m (O4).
inline constexpr double kNominalObstacleRadius_m = 0.1;

inline ContactLaw obstacle_law(double radius_m) {
  osim::ContactForce force;
  force.stiffness = 1e6 / radius_m;
  force.dissipation = 1e-5;
  return contact_law(force);
}

}  // namespace stride::laws
