#include "train/ppo/learner.h"

#include <gtest/gtest.h>

namespace stride::ppo {
namespace {

Options small() {
  Options options;
  options.actor_hidden = options.critic_hidden = {16};
  options.minibatch = 64;
  return options;
}

/// Episodes of one decision in which the right action is the one whose side's feature is positive.
RolloutBatch bandit(const Learner& learner, Random& random) {
  RolloutBatch batch;
  batch.environments = 128;
  batch.steps = 2;
  const int n = 256;
  batch.states.resize(3, n + 128);
  for (float& x : batch.states.reshaped()) x = static_cast<float>(normal(random));
  network::Mlp<float>::Workspace work;
  batch.logits = learner.actor().forward(batch.states.leftCols(n), work);
  batch.actions.resize(2, n);
  batch.rewards.resize(n);
  batch.ends.assign(n, EpisodeEnd::terminated);
  for (int i = 0; i < n; ++i) {
    batch.rewards[i] = 0;
    for (int k = 0; k < 2; ++k) {
      batch.actions(k, i) = uniform(random) < 1 / (1 + std::exp(-batch.logits(k, i))) ? 1 : 0;
      batch.rewards[i] += 3 + ((batch.states(k, i) > 0) == (batch.actions(k, i) > 0) ? 1 : 0);
    }
  }
  return batch;
}

struct Learned {
  Vector actor, critic;
  double reward;
  UpdateReport report;
};

Learned learn(int size) {
  Random weights(1), random(2), chance(3);
  Learner learner(small(), 3, 2, weights);
  training::ThreadPool threads(size);
  Learned learned{};
  for (int i = 0; i < 40; ++i) {
    RolloutBatch batch = bandit(learner, chance);
    learned.reward = batch.rewards.mean();
    learner.assess(threads, batch);
    learned.report = learner.update(batch, 0, random, threads);
  }
  learned.actor = learner.actor().parameters();
  learned.critic = learner.critic().net.parameters();
  return learned;
}

TEST(Learner, LearnsABanditWithTheDivergenceThatWasAskedFor) {
  const Learned learned = learn(1);
  EXPECT_GT(learned.reward, 7.6) << "of 8; by chance 7";
  EXPECT_GT(learned.report.kl, 0.002);
  EXPECT_LT(learned.report.kl, 0.09);
}

TEST(Learner, DoesNotDependOnTheNumberOfThreads) {
  const Learned one = learn(1), three = learn(3);
  EXPECT_EQ(one.actor, three.actor);
  EXPECT_EQ(one.critic, three.critic);
}

TEST(ScaledCritic, KeepsItsValuesWhenItsScaleMoves) {
  Random random(4);
  ScaledCritic critic{
      .net = network::Mlp<float>(
          {.inputs = 3, .outputs = 1, .hidden = {8}, .activation = network::Activation::tanh}),
      .adam = {}};
  critic.net.initialise(random, 1);
  Matrix states(3, 50);
  for (float& x : states.reshaped()) x = static_cast<float>(normal(random));
  network::Mlp<float>::Workspace work;
  const Vector before = critic.values(states, work);
  Vector returns(4000);
  for (float& x : returns) x = static_cast<float>(7 + 3 * normal(random));
  for (int i = 0; i < 3; ++i) critic.rescale(returns);
  EXPECT_LT((critic.values(states, work) - before).cwiseAbs().maxCoeff(), 1e-4f);
  EXPECT_NEAR(critic.shift, 7, 0.2);
  EXPECT_NEAR(critic.scale, 3, 0.2);
  EXPECT_NEAR(critic.scaled(returns).mean(), 0, 1e-3);
}

}  // namespace
}  // namespace stride::ppo
