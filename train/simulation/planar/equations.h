#pragma once

#include <array>

#include "train/simulation/planar/kinematics.h"

namespace stride::planar {

/// The equations of motion, M q̈ = right. Unknowns of a leg, both legs in lanes: ankle, knee, hip,
/// tilt, x, y; the rows of the base hold the leg's share.
struct PlanarEquations {
  simd::V2 matrix[6][6];  // the upper triangle
  simd::V2 right[6];
  /// The base's own body: centre of mass relative to the pelvis' origin, and its right side.
  double base_mass_kg = 0, base_x_m = 0, base_y_m = 0, base_inertia_kg_m2 = 0;
  double base_right[3] = {};
  // Of the elimination.
  simd::V2 inverse[3], factor[3][6];
  double base_matrix[3][3], base_factor[2][3];
};

/// Sets the mass matrix.
void assemble(const PlanarModel& model, const PlanarKinematics& k, PlanarEquations& equations);

/// Sets the right side: what moves the joints (hip, knee, ankle), the feet, gravity, and the
/// motion itself.
void load(const PlanarModel& model, const PlanarKinematics& k,
          const std::array<simd::V2, 3>& torque, const FootForces& feet,
          PlanarEquations& equations);

/// Eliminates the joints of both legs at once, ankle, knee, hip, then the base.
void eliminate(PlanarEquations& equations);

/// Writes the accelerations into `rate`. Spends the right sides of eliminated equations.
void solve(PlanarEquations& equations, PlanarState& rate);

}  // namespace stride::planar
