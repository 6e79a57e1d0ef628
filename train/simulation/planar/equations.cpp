#include "train/simulation/planar/equations.h"

namespace stride::planar {

using simd::both;
using simd::Pair;
using simd::sum;
using simd::V2;
using simd::V4;

void assemble(const PlanarModel& model, const PlanarKinematics& k, PlanarEquations& legs) {
  const Pair joint[3] = {k.origin[3], k.hinge, k.origin[1]};  // ankle, knee, hip
  // m_j, S_j and Q_j of all that a joint carries, about P: summed from the foot inwards.
  V2 mass{}, second{};
  Pair first{};
  for (int i = 0; i < 3; ++i) {
    const int segment = 3 - i;
    const V2 m = model.mass_kg[segment];
    mass += m;
    first = first + m * k.center[segment];
    second += model.inertia_kg_m2[segment] + m * dot(k.center[segment], k.center[segment]);
    // (4): M_ij = Q_i - S_i · (J_i + J_j) + m_i J_i · J_j; the tilt turns about P, J = 0.
    for (int j = i; j < 3; ++j) {
      legs.matrix[i][j] = second - dot(first, joint[i] + joint[j]) + mass * dot(joint[i], joint[j]);
    }
    legs.matrix[i][3] = second - dot(first, joint[i]);
    // (5): ẑ × (S_i - m_i J_i).
    legs.matrix[i][4] = mass * joint[i].y - first.y;
    legs.matrix[i][5] = first.x - mass * joint[i].x;
  }
  // The leg's share of the pelvis rows: (4) and (5) with J = 0, and its mass.
  legs.matrix[3][3] = second;
  legs.matrix[3][4] = -first.y;
  legs.matrix[3][5] = first.x;
  legs.matrix[4][4] = mass;
  legs.matrix[4][5] = V2{};
  legs.matrix[5][5] = mass;
  legs.base_mass_kg = model.mass_kg[0][0];
  legs.base_inertia_kg_m2 = model.inertia_kg_m2[0][0];
  legs.base_x_m = k.center[0].x[0], legs.base_y_m = k.center[0].y[0];
}

void load(const PlanarModel& model, const PlanarKinematics& k, const std::array<V2, 3>& torque,
          const FootForces& feet, PlanarEquations& legs) {
  // Acceleration of each segment's origin at zero q̈: -ω² r of each link, and
  // 2 ω₁ q̇ ẑ × R₁k' + q̇² R₁k'' of the knee's moving hinge.
  const auto squared = [&](int i) { return k.omega[i] * k.omega[i]; };
  const Pair gravity{both(model.gravity_x), both(model.gravity_y)};
  Pair bias[4];
  bias[1] = -squared(0) * k.origin[1];
  bias[2] = bias[1] - squared(1) * (k.origin[2] - k.origin[1]) +
            2 * k.omega[1] * k.knee_speed * perp(k.hinge_speed) +
            k.knee_speed * k.knee_speed * k.hinge_bend;
  bias[3] = bias[2] - squared(2) * (k.origin[3] - k.origin[2]);

  // (6): F and N about P, summed from the foot inwards; τ_j = torque - (N_j - J_j × F_j).
  Pair force{-feet.x, -feet.y};
  V2 turning = -feet.moment;
  const Pair joint[3] = {k.origin[3], k.hinge, k.origin[1]};
  for (int i = 0; i < 3; ++i) {
    const int segment = 3 - i;
    const Pair f =
        model.mass_kg[segment] *
        (bias[segment] - squared(segment) * (k.center[segment] - k.origin[segment]) - gravity);
    force = force + f;
    turning += cross(k.center[segment], f);
    legs.right[i] = torque[2 - i] - (turning - cross(joint[i], force));
  }
  legs.right[3] = -turning;
  legs.right[4] = -force.x;
  legs.right[5] = -force.y;

  // The same for the base's own body.
  const double m = legs.base_mass_kg, cx = legs.base_x_m, cy = legs.base_y_m;
  const double w2 = squared(0)[0];
  const double fx = m * (-w2 * cx - model.gravity_x), fy = m * (-w2 * cy - model.gravity_y);
  legs.base_right[0] = cy * fx - cx * fy;
  legs.base_right[1] = -fx;
  legs.base_right[2] = -fy;
}

void eliminate(PlanarEquations& legs) {
  // (8): for pivots p = ankle, knee, hip, L_pi = M_pi / M_pp and M_ij -= L_pi M_pj.
  for (int p = 0; p < 3; ++p) {
    legs.inverse[p] = 1 / legs.matrix[p][p];
    for (int i = p + 1; i < 6; ++i) {
      legs.factor[p][i] = legs.matrix[p][i] * legs.inverse[p];
      for (int j = i; j < 6; ++j) legs.matrix[i][j] -= legs.factor[p][i] * legs.matrix[p][j];
    }
  }
  // The pelvis: what remains of both legs, plus the base's own body, (4) and (5) with J = 0.
  const double m = legs.base_mass_kg, cx = legs.base_x_m, cy = legs.base_y_m;
  double(&a)[3][3] = legs.base_matrix;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) a[i][j] = sum(legs.matrix[3 + i][3 + j]);
  }
  a[0][0] += legs.base_inertia_kg_m2 + m * (cx * cx + cy * cy);
  a[0][1] -= m * cy;
  a[0][2] += m * cx;
  a[1][1] += m;
  a[2][2] += m;
  for (int p = 0; p < 2; ++p) {
    for (int i = p + 1; i < 3; ++i) {
      legs.base_factor[p][i] = a[p][i] / a[p][p];
      for (int j = i; j < 3; ++j) a[i][j] -= legs.base_factor[p][i] * a[p][j];
    }
  }
}

void solve(PlanarEquations& legs, PlanarState& rate) {
  // Forward substitution through both legs, then the pelvis.
  for (int p = 0; p < 3; ++p) {
    for (int i = p + 1; i < 6; ++i) legs.right[i] -= legs.factor[p][i] * legs.right[p];
  }
  double b[3];
  for (int i = 0; i < 3; ++i) b[i] = legs.base_right[i] + sum(legs.right[3 + i]);
  for (int p = 0; p < 2; ++p) {
    for (int i = p + 1; i < 3; ++i) b[i] -= legs.base_factor[p][i] * b[p];
  }
  const double(&a)[3][3] = legs.base_matrix;
  // Back substitution: the pelvis, then hip, knee, ankle.
  double base[3];
  for (int p = 2; p >= 0; --p) {
    double right = b[p];
    for (int j = p + 1; j < 3; ++j) right -= a[p][j] * base[j];
    base[p] = right / a[p][p];
  }
  V2 leg[3];
  for (int p = 2; p >= 0; --p) {
    V2 right = legs.right[p];
    for (int j = p + 1; j < 3; ++j) right -= legs.matrix[p][j] * leg[j];
    for (int j = 0; j < 3; ++j) right -= legs.matrix[p][3 + j] * both(base[j]);
    leg[p] = right * legs.inverse[p];
  }
  rate.y[PlanarState::kU] = simd::join(leg[2], leg[1]);
  rate.y[PlanarState::kU + 1] = V4{leg[0][0], leg[0][1], base[0], base[1]};
  rate.y[PlanarState::kU + 2] = V4{base[2], 0, 0, 0};
}

}  // namespace stride::planar
