#pragma once

#include <cstdint>
#include <vector>

#include "train/ppo/bernoulli.h"

namespace stride::ppo {

/// How a decision left its episode. A truncated one goes on unseen: its value is bootstrapped.
enum class EpisodeEnd : std::uint8_t { none, terminated, truncated };

/// The decisions between two updates: column step · environments + slot.
struct RolloutBatch {
  int environments = 0, steps = 0;
  Matrix states;           // normalised features
  Matrix actions, logits;  // as drawn, and the policy they were drawn from
  Vector log_probabilities;
  Vector rewards;  // shaped, with the bonus of not falling
  Vector values;   // V(s) of every column and of the state after the last
  std::vector<EpisodeEnd> ends;
  Eigen::MatrixXd observed;   // features before they are normalised
  std::vector<Matrix> after;  // s′, normalised, of each decision that was truncated; else empty
  Matrix truncated_states;    // s′ of the truncated decisions, one after the other
  Vector truncated_values;    // V(s′) of them
  Vector advantages, returns;

  int decisions() const { return environments * steps; }
};

/// Generalised advantage estimation (Schulman et al. 2016, Eq. 16): with δ = r + γ V(s′) − V(s),
/// A = δ + γ λ A′; a terminated state has no V(s′), and a chain ends with its episode. The return,
/// which the critic learns, is A + V(s).
void estimate_advantages(double gamma, double lambda, RolloutBatch& batch);

}  // namespace stride::ppo
