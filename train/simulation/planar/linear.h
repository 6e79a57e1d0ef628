#pragma once

#include <array>

#include "train/simulation/planar/equations.h"
#include "train/simulation/planar/state.h"

namespace stride::planar {

/// What makes the equations stiff, linearised at a state: the springs and dampers of contact and
/// joint limits, and the chain of tendon and fibre. With unknowns q, u, l (fibre lengths) and
///
///   q' = u,   M u' = … - K q - D u - Rᵀ(k_t R q - g l),   l' = … + J_l l + J_L R q
///
/// where R are the moment arms. It need not be exact: the integrator's order does not depend on it.
struct PlanarLinear {
  using V2 = simd::V2;
  using Fibers = PlanarFibers;
  /// A symmetric matrix over ankle, knee, hip, tilt, x, y of each leg; the upper triangle.
  struct Matrix {
    V2 at[6][6] = {};
  };
  PlanarEquations mass;  // but for the right sides
  Matrix damping, stiffness;
  std::array<std::array<V2, 3>, PlanarModel::kMusclesOfLeg> arm{};  // hip, knee, ankle
  Fibers tendon_N_m{};                                              // k_t
  Fibers fiber_N_m{};                                               // g = k_t / cos(pennation)
  Fibers fiber_1_s{};                                               // J_l
  Fibers stretch_1_s{};                                             // J_L
};

/// Solves (1/s - T) U = R for the linearisation T and a time s: the stages of the integrator.
class PlanarSolver {
 public:
  using State = PlanarState;

  void factor(const PlanarLinear& linear, double s);
  void solve(const PlanarLinear& linear, const State& right, State& result) const;

 private:
  double s_ = 0;
  PlanarLinear::Matrix system_, spring_;
  simd::V2 inverse_[3];
  double base_[3][3], base_inverse_[3];
  PlanarFibers delay_;  // s / (1 - s J_l)
  PlanarFibers pull_;   // g · delay
};

}  // namespace stride::planar
