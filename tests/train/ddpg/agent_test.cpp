#include "train/ddpg/agent.h"

#include <gtest/gtest.h>

namespace stride {
namespace {

constexpr int kStates = 4, kActions = 2, kBatch = 16;

ddpg::AgentOptions small_agent() {
  ddpg::AgentOptions options;
  options.actor_hidden = {8, 8};
  options.critic_hidden = {8, 8};
  options.tau = 0.1;
  return options;
}

ddpg::Batch<double> random_batch(Random& random) {
  ddpg::Batch<double> batch;
  batch.states.resize(kStates, kBatch);
  batch.next_states.resize(kStates, kBatch);
  batch.actions.resize(kActions, kBatch);
  batch.rewards.resize(kBatch);
  batch.discounts.setConstant(kBatch, 0.9);
  batch.discounts[3] = 0;
  for (double& v : batch.states.reshaped()) v = normal(random);
  for (double& v : batch.next_states.reshaped()) v = normal(random);
  for (double& v : batch.actions.reshaped()) v = uniform(random);
  for (double& v : batch.rewards.reshaped()) v = normal(random);
  return batch;
}

double q(const network::Mlp<double>& critic, const Eigen::VectorXd& state,
         const Eigen::VectorXd& action) {
  Eigen::VectorXd input(kStates + kActions);
  input << state, action;
  network::Mlp<double>::Workspace work;
  return critic.forward(input, work)(0, 0);
}

Eigen::VectorXd mu(const network::Mlp<double>& actor, const Eigen::VectorXd& state) {
  network::Mlp<double>::Workspace work;
  return actor.forward(state, work).col(0);
}

/// L = 1/N Σ ½ (y − Q)², sample by sample as in the paper of DDPG.
double critic_loss(ddpg::Agent<double>& agent, const ddpg::Batch<double>& batch) {
  double loss = 0;
  for (int i = 0; i < kBatch; ++i) {
    const Eigen::VectorXd next = batch.next_states.col(i);
    const double y = batch.rewards[i] + batch.discounts[i] * q(agent.critics()[0].target, next,
                                                               mu(agent.actor_target(), next));
    const double error =
        y - q(agent.critics()[0].network, batch.states.col(i), batch.actions.col(i));
    loss += error * error / 2 / kBatch;
  }
  return loss;
}

/// J = 1/N Σ Q(s, μ(s)).
double actor_value(ddpg::Agent<double>& agent, const network::Mlp<double>& critic,
                   const ddpg::Batch<double>& batch) {
  double value = 0;
  for (int i = 0; i < kBatch; ++i)
    value += q(critic, batch.states.col(i), mu(agent.actor(), batch.states.col(i))) / kBatch;
  return value;
}

/// The gradient from Adam's first step: m = (1 − β₁) g.
Eigen::VectorXd seen(const network::Adam<double>& adam) {
  return adam.m / (1 - adam.options.beta1);
}

TEST(Agent, CriticDescendsAndActorAscendsTheGradientsOfDdpg) {
  Random random(5);
  ddpg::Agent<double> agent(small_agent(), kStates, kActions, random);
  for (auto& p : {&agent.critics()[0].network, &agent.critics()[0].target, &agent.actor(),
                  &agent.actor_target()})
    for (double& v : p->parameters()) v += 0.1 * normal(random);
  const ddpg::Batch<double> batch = random_batch(random);
  ddpg::Agent<double> moved = agent;
  const ddpg::UpdateLosses losses = agent.update(batch, 1);
  EXPECT_NEAR(losses.critic_loss, critic_loss(moved, batch), 1e-12);

  const double h = 1e-6;
  const auto difference = [&](double& variable, const auto& value) {
    const double at = variable;
    variable = at + h;
    const double above = value();
    variable = at - h;
    const double below = value();
    variable = at;
    return (above - below) / (2 * h);
  };
  const Eigen::VectorXd critic_gradient = seen(agent.critics()[0].adam);
  for (Eigen::Index i = 0; i < critic_gradient.size(); i += 3)
    ASSERT_NEAR(critic_gradient[i],
                difference(moved.critics()[0].network.parameters()[i],
                           [&] { return critic_loss(moved, batch); }),
                1e-7);
  const Eigen::VectorXd actor_gradient = seen(agent.actor_adam());
  const network::Mlp<double>& critic =
      agent.critics()[0].network;  // the actor follows the fitted critic
  for (Eigen::Index i = 0; i < actor_gradient.size(); i += 3)
    ASSERT_NEAR(-actor_gradient[i],
                difference(moved.actor().parameters()[i],
                           [&] { return actor_value(moved, critic, batch); }),
                1e-7);
}

TEST(Agent, TargetsFollowByTau) {
  Random random(6);
  ddpg::Agent<double> agent(small_agent(), kStates, kActions, random);
  const Eigen::VectorXd before = agent.actor_target().parameters();
  agent.update(random_batch(random), 1);
  EXPECT_LT((agent.actor_target().parameters() - (0.1 * agent.actor().parameters() + 0.9 * before))
                .norm(),
            1e-14);
}

TEST(Agent, LargeErrorsCountLinearlyIfLimited) {
  Random random(7), same(7);
  ddpg::AgentOptions options = small_agent();
  ddpg::Agent<double> plain(options, kStates, kActions, random);
  options.error_limit = 1;
  ddpg::Agent<double> limited(options, kStates, kActions, same);
  ddpg::Batch<double> batch = random_batch(random);
  batch.rewards.setConstant(100);
  batch.discounts.setZero();
  EXPECT_NEAR(plain.update(batch, 1).critic_loss, 5000, 50);
  EXPECT_NEAR(limited.update(batch, 1).critic_loss, 99.5, 0.5);
  EXPECT_NEAR(seen(limited.critics()[0].adam).norm() * 100, seen(plain.critics()[0].adam).norm(),
              0.02 * seen(plain.critics()[0].adam).norm());
}

/// Wiewiora 2003, with function approximation: learning Q_θ from rewards with F is learning the
/// critic Φ(s) + Q_θ(s, a) from rewards without. Both have the same TD error, so the same gradient.
TEST(Agent, ShapingEqualsACriticThatStartsFromThePotential) {
  Random random(8);
  ddpg::Agent<double> agent(small_agent(), kStates, kActions, random);
  for (double& v : agent.critics()[0].network.parameters()) v += 0.1 * normal(random);
  agent.critics()[0].target = agent.critics()[0].network;
  ddpg::Batch<double> batch = random_batch(random);
  const auto phi = [](const Eigen::VectorXd& s) { return 5 / (0.1 + s.squaredNorm()); };

  // The plain rewards, and the critic Φ + Q_θ: its TD errors by hand, and from them ∂L/∂θ.
  const network::Mlp<double>& critic = agent.critics()[0].network;
  Eigen::MatrixXd input(kStates + kActions, kBatch);
  input << batch.states, batch.actions;
  network::Mlp<double>::Workspace work;
  const Eigen::MatrixXd values = critic.forward(input, work);
  Eigen::MatrixXd error(1, kBatch);
  for (int i = 0; i < kBatch; ++i) {
    const Eigen::VectorXd state = batch.states.col(i), next = batch.next_states.col(i);
    const double target =
        batch.rewards[i] + batch.discounts[i] * (phi(next) + q(agent.critics()[0].target, next,
                                                               mu(agent.actor_target(), next)));
    error(0, i) = (phi(state) + values(0, i) - target) / kBatch;
  }
  Eigen::VectorXd gradient;
  critic.backward(input, error, work, &gradient, false);

  for (int i = 0; i < kBatch; ++i)
    batch.rewards[i] +=
        batch.discounts[i] * phi(batch.next_states.col(i)) - phi(batch.states.col(i));
  agent.update(batch, 1);
  EXPECT_LT((seen(agent.critics()[0].adam) - gradient).norm(), 1e-10 * gradient.norm());
}

TEST(Agent, TwoCriticsGiveTheLowerTarget) {
  Random random(9);
  ddpg::AgentOptions options = small_agent();
  options.critics = 2;
  ddpg::Agent<double> agent(options, kStates, kActions, random);
  for (auto& critic : agent.critics())
    for (double& v : critic.target.parameters()) v += 0.2 * normal(random);
  ddpg::Batch<double> batch = random_batch(random);
  double expected = 0;
  for (int i = 0; i < kBatch; ++i) {
    const Eigen::VectorXd next = batch.next_states.col(i), action = mu(agent.actor_target(), next);
    expected += (batch.rewards[i] +
                 batch.discounts[i] * std::min(q(agent.critics()[0].target, next, action),
                                               q(agent.critics()[1].target, next, action))) /
                kBatch;
  }
  EXPECT_NEAR(agent.update(batch, 1).target, expected, 1e-12);
}

}  // namespace
}  // namespace stride
