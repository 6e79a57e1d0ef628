#include "train/ddpg/agent.h"

#include <algorithm>
#include <cmath>

namespace stride::ddpg {
namespace {

constexpr double kLastLayerRange = 3e-3;  // Lillicrap et al. 2016, Sec. 7

network::MlpShape actor_shape(const AgentOptions& options, int states, int actions) {
  return {.inputs = states,
          .outputs = actions,
          .hidden = options.actor_hidden,
          .activation = network::activation(options.actor_activation),
          .output = network::Activation::sigmoid,
          .layer_norm = options.layer_norm};
}

network::MlpShape critic_shape(const AgentOptions& options, int states, int actions) {
  return {.inputs = states + actions,
          .outputs = 1,
          .hidden = options.critic_hidden,
          .activation = network::activation(options.critic_activation),
          .output = network::Activation::linear,
          .layer_norm = options.layer_norm};
}

}  // namespace

template <typename Scalar>
Agent<Scalar>::Agent(const AgentOptions& options, int states, int actions, Random& random)
    : options_(options), actor_(actor_shape(options, states, actions)), actor_target_(actor_) {
  const network::AdamOptions adam{.beta2 = options.beta2,
                                  .gradient_norm_limit = options.gradient_norm_limit};
  actor_.initialise(random, kLastLayerRange);
  actor_target_ = actor_;
  actor_adam_.options = adam;
  for (int i = 0; i < options.critics; ++i) {
    Network network(critic_shape(options, states, actions));
    network.initialise(random, kLastLayerRange);
    Critic& critic = critics_.emplace_back(Critic{network, network, {}});
    critic.adam.options = adam;
    critic.adam.options.weight_decay = options.weight_decay;
  }
}

template <typename Scalar>
UpdateLosses Agent<Scalar>::update(const Batch<Scalar>& batch, double rate) {
  UpdateLosses losses;
  find_targets(batch);                                                         // (1)
  for (Critic& critic : critics_) fit_critic(critic, batch, rate, losses);     // (2)
  improve_actor(batch, rate, losses);                                          // (3)
  for (Critic& critic : critics_) soft_update(critic.network, critic.target);  // (4)
  soft_update(actor_, actor_target_);
  return losses;
}

/// (1)  yᵢ = rᵢ + γ Q′(sᵢ₊₁, μ′(sᵢ₊₁)), where rᵢ includes the shaping reward Fᵢ and γ is 0 after a
/// fall; over n steps rᵢ is their discounted sum and γ becomes γⁿ.
template <typename Scalar>
void Agent<Scalar>::find_targets(const Batch<Scalar>& batch) {
  const Eigen::Index states = batch.states.rows(), actions = batch.actions.rows();
  state_action_.resize(states + actions, batch.states.cols());
  state_action_.topRows(states) = batch.next_states;
  state_action_.bottomRows(actions) = actor_target_.forward(batch.next_states, actor_work_);
  for (std::size_t i = 0; i < critics_.size(); ++i) {
    const Matrix& q = critics_[i].target.forward(state_action_, critic_work_);
    if (i == 0)
      y_ = q;
    else
      y_ = y_.cwiseMin(q.row(0));
  }
  y_ = batch.rewards + batch.discounts.cwiseProduct(y_);
}

/// (2)  L = 1/N Σ ½ (yᵢ − Q(sᵢ, aᵢ))², descended by Adam.
template <typename Scalar>
void Agent<Scalar>::fit_critic(Critic& critic, const Batch<Scalar>& batch, double rate,
                               UpdateLosses& losses) {
  state_action_.topRows(batch.states.rows()) = batch.states;
  state_action_.bottomRows(batch.actions.rows()) = batch.actions;
  const Matrix& q = critic.network.forward(state_action_, critic_work_);
  error_ = q.row(0) - y_;
  const auto n = static_cast<Scalar>(error_.size());
  if (const auto limit = static_cast<Scalar>(options_.error_limit); limit > 0) {
    const auto size = error_.array().abs();
    losses.critic_loss = static_cast<double>(
        (size < limit).select(size.square() / 2, limit * (size - limit / 2)).mean());
    error_ = error_.cwiseMax(-limit).cwiseMin(limit).eval();
  } else {
    losses.critic_loss = static_cast<double>(error_.squaredNorm() / (2 * n));
  }
  losses.q = static_cast<double>(q.mean());
  losses.target = static_cast<double>(y_.mean());
  error_ /= n;
  critic.network.backward(state_action_, error_, critic_work_, &gradient_, false);
  losses.critic_gradient_norm =
      critic.adam.descend(critic.network.parameters(), gradient_, rate * options_.critic_rate);
}

/// (3)  ∇J ≈ 1/N Σ ∇ₐQ(sᵢ, a)|ₐ₌μ(sᵢ) ∇θ μ(sᵢ), ascended by Adam.
template <typename Scalar>
void Agent<Scalar>::improve_actor(const Batch<Scalar>& batch, double rate, UpdateLosses& losses) {
  const Eigen::Index states = batch.states.rows(), actions = batch.actions.rows();
  state_action_.topRows(states) = batch.states;
  state_action_.bottomRows(actions) = actor_.forward(batch.states, actor_work_);
  const Network& critic = critics_.front().network;
  critic.forward(state_action_, critic_work_);
  error_.setConstant(Scalar(-1) / static_cast<Scalar>(batch.states.cols()));
  critic.backward(state_action_, error_, critic_work_, nullptr, true);
  action_gradient_ = critic_work_.input_gradient.bottomRows(actions);
  actor_.backward(batch.states, action_gradient_, actor_work_, &gradient_, false);
  losses.actor_gradient_norm =
      actor_adam_.descend(actor_.parameters(), gradient_, rate * options_.actor_rate);
}

/// (4)  θ′ ← τ θ + (1 − τ) θ′.
template <typename Scalar>
void Agent<Scalar>::soft_update(const Network& network, Network& target) const {
  const auto tau = static_cast<Scalar>(options_.tau);
  target.parameters() += tau * (network.parameters() - target.parameters());
}

template class Agent<float>;
template class Agent<double>;

}  // namespace stride::ddpg
