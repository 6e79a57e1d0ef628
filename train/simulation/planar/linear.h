#pragma once

#include <array>

#include "train/simulation/planar/equations.h"
#include "train/simulation/planar/state.h"

namespace stride::planar {

/// The stiff part of the equations, linearised at a state: springs and dampers of contact and joint
/// limits, tendons and fibres. With coordinates q, speeds u, fibre lengths l and moment arms R
///
///   q' = u
///   M u' = … - K q - D u - Rᵀ (k_t R q - g l)
///   l' = … + J_l l + J_L R q
///
/// An approximation suffices, because the order of the integrator does not depend on it.
struct PlanarLinear {
  using V2 = simd::V2;
  using Fibers = PlanarFibers;
  /// A matrix over ankle, knee, hip, tilt, x, y of each leg. Friction makes it asymmetric.
  struct Matrix {
    V2 at[6][6] = {};
  };
  PlanarEquations mass;  // M; the right sides are not set
  Matrix damping, stiffness;
  std::array<std::array<V2, 3>, PlanarModel::kMusclesOfLeg> arm{};  // hip, knee, ankle
  Fibers tendon_N_m{};                                              // k_t
  Fibers fiber_N_m{};                                               // g = k_t / cos(pennation)
  Fibers fiber_1_s{};                                               // J_l
  Fibers stretch_1_s{};                                             // J_L
};

/// Solves (1/s - T) U = B for the linearisation T and s = hγ, once a stage of the integrator. By
/// rows, with U = (q, u, l) and B = (b_q, b_u, b_l):
///
///   (a)  q = s (b_q + u)
///   (b)  l = d (b_l + J_L R q),                       d = s / (1 - s J_l)
///   (c)  W u = s (M b_u + Rᵀ g d b_l - s K' b_q),     K' = K + Rᵀ (k_t - g d J_L) R
///                                                     W = M + s D + s² K', README (9)
class PlanarSolver {
 public:
  using State = PlanarState;

  void factor(const PlanarLinear& linear, double s);
  void solve(const PlanarLinear& linear, const State& right, State& result) const;

 private:
  double s_ = 0;
  PlanarLinear::Matrix system_, spring_;
  simd::V2 inverse_[3], lower_[6][3];  // lower_[i][p]: of row p, what row i loses
  double base_[3][3], base_inverse_[3];
  PlanarFibers delay_;  // d
  PlanarFibers pull_;   // g d
};

}  // namespace stride::planar
