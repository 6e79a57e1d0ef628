#pragma once

#include "train/ddpg/agent.h"

namespace stride::ddpg {

/// How fast a learner is on one core of this machine.
struct LearnerSpeed {
  double updates_per_s = 0, actions_per_s = 0;
  double update_flops = 0;   // 1/s, of the matrix products in updates
  double product_flops = 0;  // 1/s, of the matrix product of a hidden layer alone
};

/// Measures for about 1.5 `seconds`, on random batches.
template <typename Scalar>
LearnerSpeed measure_learner(const AgentOptions& options, int states, int actions, double seconds);

}  // namespace stride::ddpg
