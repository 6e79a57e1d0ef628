#pragma once

#include <array>

namespace stride::integration {

/// ROS34PW2, a Rosenbrock–W method of Rang and Angermann (2005, BIT 45:761): four stages, third
/// order with an embedded second, L-stable, and of that order for any approximation of the
/// Jacobian. The stages of y' = f(y) with the approximate Jacobian T are
///
///   (1/(h γ) - T) U_i = f(t + h time[i], y + Σ_j at[i][j] U_j) + Σ_j carry[i][j] / h U_j
///
/// and the result is y + Σ weight[i] U_i, with the estimated error Σ error[i] U_i.
struct Rosenbrock {
  static constexpr int kStages = 4;
  using Row = std::array<double, kStages>;
  using Square = std::array<Row, kStages>;

  static constexpr double kGamma = 4.3586652150845900e-01;
  static constexpr Square kAlpha = {
      {{}, {8.7173304301691801e-01}, {8.4457060015369423e-01, -1.1299064236484185e-01}, {0, 0, 1}}};
  static constexpr Square kGammas = {
      {{kGamma},
       {-8.7173304301691801e-01, kGamma},
       {-9.0338057013044082e-01, 5.4180672388095326e-02, kGamma},
       {2.4212380706095346e-01, -1.2232505839045147e+00, 5.4526025533510214e-01, kGamma}}};
  static constexpr Row kWeight = {2.4212380706095346e-01, -1.2232505839045147e+00,
                                  1.5452602553351020e+00, 4.3586652150845900e-01};
  static constexpr Row kEmbedded = {3.7810903145819369e-01, -9.6042292212423178e-02, 0.5,
                                    2.1793326075422950e-01};

  Square at{}, carry{};
  Row time{}, weight{}, error{};

  /// The published coefficients, transformed so that no stage multiplies by T (Hairer and Wanner,
  /// IV.7): U = h Γ k.
  constexpr Rosenbrock() {
    Square inverse{};  // of Γ, which is triangular
    for (int j = 0; j < kStages; ++j) {
      inverse[j][j] = 1 / kGamma;
      for (int i = j + 1; i < kStages; ++i) {
        for (int k = j; k < i; ++k) inverse[i][j] -= kGammas[i][k] * inverse[k][j] / kGamma;
      }
    }
    for (int i = 0; i < kStages; ++i) {
      for (int j = 0; j < kStages; ++j) {
        for (int k = 0; k < kStages; ++k) at[i][j] += kAlpha[i][k] * inverse[k][j];
        carry[i][j] = (i == j ? 1 / kGamma : 0) - inverse[i][j];
        time[i] += kAlpha[i][j];
        weight[i] += kWeight[j] * inverse[j][i];
        error[i] += (kWeight[j] - kEmbedded[j]) * inverse[j][i];
      }
    }
  }
};

inline constexpr Rosenbrock kRosenbrock;

}  // namespace stride::integration
