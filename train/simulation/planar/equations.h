#pragma once

#include <array>

#include "train/simulation/planar/kinematics.h"

namespace stride::planar {

/// The equations of motion, M q̈ = right. Rows: ankle, knee, hip, tilt, x, y, both legs in lanes.
/// The last three rows hold each leg's share of the pelvis; the sum over the legs and the base's
/// own body is its equation. Numbers in parentheses refer to ../README.md.
struct PlanarEquations {
  simd::V2 matrix[6][6];  // the upper triangle
  simd::V2 right[6];
  /// The base's own body: mass, centre of mass relative to the pelvis origin, right side.
  double base_mass_kg = 0, base_x_m = 0, base_y_m = 0, base_inertia_kg_m2 = 0;
  double base_right[3] = {};
  // Results of eliminate().
  simd::V2 inverse[3], factor[3][6];
  double base_matrix[3][3], base_factor[2][3];
};

/// Sets the mass matrix, (4) and (5).
void assemble(const PlanarModel& model, const PlanarKinematics& k, PlanarEquations& equations);

/// Sets the right side, (6): joint torques (hip, knee, ankle), contact forces of the feet, gravity,
/// and centrifugal and Coriolis terms.
void load(const PlanarModel& model, const PlanarKinematics& k,
          const std::array<simd::V2, 3>& torque, const FootForces& feet,
          PlanarEquations& equations);

/// Factors M, (8): ankle, knee, hip of both legs at once, then the pelvis.
void eliminate(PlanarEquations& equations);

/// Writes q̈ into the speeds of `rate`. Needs eliminate() and load(); overwrites the right sides.
void solve(PlanarEquations& equations, PlanarState& rate);

}  // namespace stride::planar
