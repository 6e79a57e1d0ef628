#pragma once

#include <Eigen/Core>

namespace stride::ppo {

using Matrix = Eigen::MatrixXf;
using Vector = Eigen::VectorXf;

/// Excitations that are drawn one by one as 0 or 1. p = 1 / (1 + e⁻ᶻ) is the probability of a 1 and
/// z its logit. Matrices have a column a sample and a row an action; sums are over the actions.

/// log p(action).
Vector log_probability(const Eigen::Ref<const Matrix>& logits,
                       const Eigen::Ref<const Matrix>& actions);

/// KL(before ‖ now) ≥ 0.
Vector divergence(const Eigen::Ref<const Matrix>& before, const Eigen::Ref<const Matrix>& now);

/// Entropy, nats.
Vector entropy(const Eigen::Ref<const Matrix>& logits);

/// ∂ log p(action)/∂z = action − p, and ∂ entropy/∂z = −z p (1 − p).
Matrix log_probability_gradient(const Eigen::Ref<const Matrix>& logits,
                                const Eigen::Ref<const Matrix>& actions);
Matrix entropy_gradient(const Eigen::Ref<const Matrix>& logits);

}  // namespace stride::ppo
