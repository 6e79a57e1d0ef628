#pragma once

#include <string>
#include <vector>

#include "train/ppo/rollout_batch.h"
#include "train/ppo/scaled_critic.h"
#include "train/training/options.h"
#include "train/training/thread_pool.h"

namespace stride::ppo {

using Options = training::PpoOptions;

/// How an update went, means over its last pass.
struct UpdateReport {
  double kl = 0, entropy = 0, value_loss = 0, explained_variance = 0;
  double actor_gradient = 0, critic_gradient = 0;
  int steps = 0;  // of Adam
};

/// The policy's logits, the critic, and what steers them.
class Learner {
 public:
  Learner(const Options& options, int features, int actions, Random& weights);

  /// V of the batch's states, and advantages.
  void assess(training::ThreadPool& threads, RolloutBatch& batch);

  /// The passes of stochastic gradient descent over an assessed batch. `age` in [0, 1] is the share
  /// of decay_decisions that is over. The result does not depend on the number of threads.
  UpdateReport update(const RolloutBatch& batch, double age, Random& random,
                      training::ThreadPool& threads);

  const network::Mlp<float>& actor() const { return actor_; }
  network::Mlp<float>& actor() { return actor_; }
  ScaledCritic& critic() { return critic_; }
  const ScaledCritic& critic() const { return critic_; }
  network::Adam<float>& actor_adam() { return actor_adam_; }
  const network::Adam<float>& actor_adam() const { return actor_adam_; }
  double& rate() { return rate_; }  // of the actor
  double rate() const { return rate_; }

 private:
  Options options_;
  network::Mlp<float> actor_;
  network::Adam<float> actor_adam_;
  ScaledCritic critic_;
  double rate_;
};

}  // namespace stride::ppo
