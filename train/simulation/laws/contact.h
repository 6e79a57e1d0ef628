#pragma once

// C++17-clean and free of Simbody and Eigen.

#include <algorithm>
#include <cmath>

#include "calibrate/osim/model.h"

namespace stride::laws {

/// Contact of a sphere with the ground or another sphere: Hertz's spring with Hunt–Crossley damping
/// and the regularised friction of Simbody's HuntCrossleyForce, for two bodies of the same
/// material. The force acts at half the depth, along the line of centres.
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

/// The normal force, N. Negative where damping would pull; there is then neither normal force nor
/// friction. `radius_m` is the sphere's, or r₁r₂/(r₁+r₂) between two spheres.
inline double normal_force(const ContactLaw& law, double radius_m, double depth_m,
                           double approach_m_s) {
  if (depth_m <= 0) return 0;
  const double kx = law.plane_strain_modulus * depth_m;
  const double hertz = 4.0 / 3 * kx * std::sqrt(radius_m * kx);
  return hertz * (1 + 1.5 * law.dissipation * approach_m_s);
}

/// The friction force at a slip speed `slip_m_s` ≥ 0, N. It is linear below the transition
/// velocity, so there is no stiction.
inline double friction_force(const ContactLaw& law, double normal_N, double slip_m_s) {
  const double v = slip_m_s / law.transition_velocity_m_s;
  const double us = law.static_friction, ud = law.dynamic_friction;
  return normal_N *
         (std::min(v, 1.0) * (ud + 2 * (us - ud) / (1 + v * v)) + law.viscous_friction * slip_m_s);
}

/// Simbody's HuntCrossleyForce stops at the first contact of its element whose force is not
/// positive and drops the remaining ones. Their order is that of Simbody's sweep, along the axis
/// with the largest variance of the plane's origin and the spheres' centres. True if the first of a
/// foot's two spheres comes first; centres in the ground, m.
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

/// Obstacles of "Learning to Run": frictionless, with stiffness 1e6/r for the radius r in the
/// competition's scene; there, however, each collides as a sphere of 0.1 m.
inline constexpr double kNominalObstacleRadius_m = 0.1;

inline ContactLaw obstacle_law(double radius_m) {
  osim::ContactForce force;
  force.stiffness = 1e6 / radius_m;
  force.dissipation = 1e-5;
  return contact_law(force);
}

}  // namespace stride::laws
