#include "train/simulation/planar/linear.h"

#include <algorithm>
#include <cstring>

namespace stride::planar {

using simd::both;
using simd::sum;
using simd::V2;
using simd::V4;

namespace {

/// A vector over ankle, knee, hip of both legs (in lanes) and tilt, x, y of the pelvis.
struct Rows {
  V2 leg[3];
  double base[3];
};

Rows rows_of(const PlanarState& y, int first) {
  const V4 a = y.y[first], b = y.y[first + 1], c = y.y[first + 2];
  return {{V2{b[0], b[1]}, V2{a[2], a[3]}, V2{a[0], a[1]}}, {b[2], b[3], c[0]}};
}

void set_rows(PlanarState& y, int first, const Rows& r) {
  y.y[first] = simd::join(r.leg[2], r.leg[1]);
  y.y[first + 1] = V4{r.leg[0][0], r.leg[0][1], r.base[0], r.base[1]};
  y.y[first + 2] = V4{r.base[2], 0, 0, 0};
}

/// result += factor · matrix · x, where element(i, j) is of the matrix
template <typename Element>
void multiply(const Element& element, double factor, const Rows& x, Rows& result) {
  V2 in[6], out[6] = {};
  for (int i = 0; i < 3; ++i) in[i] = x.leg[i], in[3 + i] = both(x.base[i]);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) out[i] += element(i, j) * in[j];
  for (int i = 0; i < 3; ++i) {
    result.leg[i] += factor * out[i];
    result.base[i] += factor * sum(out[3 + i]);
  }
}

const double* lanes(const PlanarFibers& f) { return reinterpret_cast<const double*>(f.data()); }

V2 of_muscle(const PlanarFibers& f, int muscle) {
  V2 v;
  std::memcpy(&v, lanes(f) + 2 * muscle, sizeof v);
  return v;
}

}  // namespace

void PlanarSolver::factor(const PlanarLinear& linear, double s) {
  s_ = s;
  // d and g d of (b), four muscles at a time.
  for (int g = 0; g < PlanarModel::kMuscleGroups; ++g) {
    delay_[g] = s / (1 - s * linear.fiber_1_s[g]);
    pull_[g] = linear.fiber_N_m[g] * delay_[g];
  }
  // K' = K + Rᵀ (k_t - g d J_L) R. Rows are ankle, knee, hip; arms are hip, knee, ankle.
  spring_ = linear.stiffness;
  PlanarFibers stiffness;
  for (int g = 0; g < PlanarModel::kMuscleGroups; ++g) {
    stiffness[g] = linear.tendon_N_m[g] - pull_[g] * linear.stretch_1_s[g];
  }
  for (int m = 0; m < PlanarModel::kMusclesOfLeg; ++m) {
    const V2 k = of_muscle(stiffness, m);
    const std::array<V2, 3>& arm = linear.arm[m];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) spring_.at[i][j] += k * arm[2 - i] * arm[2 - j];
    }
  }
  // W = M + s D + s² K'.
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      system_.at[i][j] = linear.mass.matrix[std::min(i, j)][std::max(i, j)] +
                         s * linear.damping.at[i][j] + s * s * spring_.at[i][j];
    }
  }
  // Eliminate ankle, knee, hip of both legs: W_ij -= W_pi W_pj / W_pp.
  for (int p = 0; p < 3; ++p) {
    inverse_[p] = 1 / system_.at[p][p];
    for (int i = p + 1; i < 6; ++i) {
      lower_[i][p] = system_.at[i][p] * inverse_[p];
      for (int j = p + 1; j < 6; ++j) system_.at[i][j] -= lower_[i][p] * system_.at[p][j];
    }
  }
  // What remains of both legs, plus the mass matrix of the base's own body: 3×3 for the pelvis.
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) base_[i][j] = sum(system_.at[3 + i][3 + j]);
  }
  const double m = linear.mass.base_mass_kg, x = linear.mass.base_x_m, y = linear.mass.base_y_m;
  base_[0][0] += linear.mass.base_inertia_kg_m2 + m * (x * x + y * y);
  base_[0][1] -= m * y, base_[1][0] -= m * y;
  base_[0][2] += m * x, base_[2][0] += m * x;
  base_[1][1] += m;
  base_[2][2] += m;
  for (int p = 0; p < 3; ++p) {
    base_inverse_[p] = 1 / base_[p][p];
    for (int i = p + 1; i < 3; ++i) {
      base_[i][p] *= base_inverse_[p];
      for (int j = p + 1; j < 3; ++j) base_[i][j] -= base_[i][p] * base_[p][j];
    }
  }
}

void PlanarSolver::solve(const PlanarLinear& linear, const State& right, State& result) const {
  const Rows rq = rows_of(right, 0), ru = rows_of(right, State::kU);
  // The right side of (c), over s: first M b_u, of the legs and of the base's own body,
  Rows b{};
  const auto& mass = linear.mass.matrix;  // its upper triangle
  multiply([&](int i, int j) { return mass[std::min(i, j)][std::max(i, j)]; }, 1, ru, b);
  const double m = linear.mass.base_mass_kg, x = linear.mass.base_x_m, y = linear.mass.base_y_m;
  b.base[0] += (linear.mass.base_inertia_kg_m2 + m * (x * x + y * y)) * ru.base[0] -
               m * y * ru.base[1] + m * x * ru.base[2];
  b.base[1] += m * (ru.base[1] - y * ru.base[0]);
  b.base[2] += m * (ru.base[2] + x * ru.base[0]);
  multiply([&](int i, int j) { return spring_.at[i][j]; }, -s_, rq, b);
  PlanarFibers pulled;
  for (int g = 0; g < PlanarModel::kMuscleGroups; ++g) {
    pulled[g] = pull_[g] * right.y[State::kFiber + g];
  }
  for (int n = 0; n < PlanarModel::kMusclesOfLeg; ++n) {
    const V2 f = of_muscle(pulled, n);
    for (int i = 0; i < 3; ++i) b.leg[i] += f * linear.arm[n][2 - i];
  }
  // Forward substitution through the legs,
  V2 r[6];
  for (int i = 0; i < 3; ++i) r[i] = s_ * b.leg[i], r[3 + i] = V2{};
  for (int p = 0; p < 3; ++p) {
    for (int i = p + 1; i < 6; ++i) r[i] -= lower_[i][p] * r[p];
  }
  // then the pelvis,
  double c[3];
  for (int i = 0; i < 3; ++i) c[i] = s_ * b.base[i] + sum(r[3 + i]);
  for (int p = 0; p < 2; ++p) {
    for (int i = p + 1; i < 3; ++i) c[i] -= base_[i][p] * c[p];
  }
  Rows u;
  for (int p = 2; p >= 0; --p) {
    for (int j = p + 1; j < 3; ++j) c[p] -= base_[p][j] * u.base[j];
    u.base[p] = c[p] * base_inverse_[p];
  }
  // and back through hip, knee, ankle.
  for (int p = 2; p >= 0; --p) {
    V2 left = r[p];
    for (int j = p + 1; j < 3; ++j) left -= system_.at[p][j] * u.leg[j];
    for (int j = 0; j < 3; ++j) left -= system_.at[p][3 + j] * both(u.base[j]);
    u.leg[p] = left * inverse_[p];
  }
  // (a)
  Rows q;
  for (int i = 0; i < 3; ++i) {
    q.leg[i] = s_ * (rq.leg[i] + u.leg[i]);
    q.base[i] = s_ * (rq.base[i] + u.base[i]);
  }
  set_rows(result, 0, q);
  set_rows(result, State::kU, u);
  // (b), with R q by muscle of a leg; the tenth fills the last group of four.
  V2 stretch[PlanarModel::kMusclesOfLeg + 1];
  for (int n = 0; n < PlanarModel::kMusclesOfLeg; ++n) {
    stretch[n] =
        linear.arm[n][0] * q.leg[2] + linear.arm[n][1] * q.leg[1] + linear.arm[n][2] * q.leg[0];
  }
  stretch[9] = stretch[8];
  for (int g = 0; g < PlanarModel::kMuscleGroups; ++g) {
    const V4 d = simd::join(stretch[2 * g], stretch[2 * g + 1]);
    result.y[State::kFiber + g] =
        delay_[g] * (right.y[State::kFiber + g] + linear.stretch_1_s[g] * d);
  }
}

}  // namespace stride::planar
