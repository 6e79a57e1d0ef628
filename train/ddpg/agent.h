#pragma once

#include <string>
#include <vector>

#include "train/ddpg/replay_buffer.h"
#include "train/network/adam.h"
#include "train/network/mlp.h"

namespace stride::ddpg {

struct AgentOptions {
  std::vector<int> actor_hidden{128, 128}, critic_hidden{128, 128};
  std::string actor_activation = "elu", critic_activation = "elu";
  bool layer_norm = true;
  double gamma = 0.985;      // a decision; shaping uses the same
  double tau = 2e-3;         // of the soft update of the targets
  double actor_rate = 3e-4;  // Adam's α
  double critic_rate = 1e-3;
  double final_rate = 0.2;  // factor on the rates after decay_decisions
  double decay_decisions = 4e6;
  double beta2 = 0.999;
  double weight_decay = 0;         // of the critic
  double gradient_norm_limit = 0;  // of either network; 0: none
  double error_limit = 0;          // TD errors beyond it count linearly (Huber); 0: never
  int critics = 1;                 // 2: targets take the lower of two (Fujimoto et al. 2018)
  int n_step = 3;
  int batch = 128;
};

/// Means over one update.
struct UpdateLosses {
  double critic_loss = 0;  // ½ (y − Q)², or its Huber form
  double q = 0;            // Q(s, a) of the sampled actions
  double target = 0;       // y
  double actor_gradient_norm = 0, critic_gradient_norm = 0;
};

/// Deep Deterministic Policy Gradient (Lillicrap et al. 2016): an actor μ, critics Q, and their
/// target networks μ′, Q′. States are normalised, actions are in [0, 1].
template <typename Scalar>
class Agent {
 public:
  using Network = network::Mlp<Scalar>;
  using Matrix = typename Network::Matrix;
  using Vector = typename Network::Vector;

  Agent(const AgentOptions& options, int states, int actions, Random& random);

  /// One update, equations (1) to (4) of train/README.md. `rate` scales both learning rates.
  UpdateLosses update(const Batch<Scalar>& batch, double rate);

  const Network& actor() const { return actor_; }

  struct Critic {
    Network network, target;
    network::Adam<Scalar> adam = {};
  };
  /// For files and tests.
  Network& actor() { return actor_; }
  Network& actor_target() { return actor_target_; }
  network::Adam<Scalar>& actor_adam() { return actor_adam_; }
  std::vector<Critic>& critics() { return critics_; }

 private:
  using Workspace = typename Network::Workspace;
  using Row = Eigen::Matrix<Scalar, 1, Eigen::Dynamic>;

  void find_targets(const Batch<Scalar>& batch);
  void fit_critic(Critic& critic, const Batch<Scalar>& batch, double rate, UpdateLosses& losses);
  void improve_actor(const Batch<Scalar>& batch, double rate, UpdateLosses& losses);
  void soft_update(const Network& network, Network& target) const;

  AgentOptions options_;
  Network actor_, actor_target_;
  network::Adam<Scalar> actor_adam_;
  std::vector<Critic> critics_;
  Workspace actor_work_, critic_work_;
  Matrix state_action_, action_gradient_;
  Row y_, error_;
  Vector gradient_;
};

extern template class Agent<float>;
extern template class Agent<double>;

}  // namespace stride::ddpg
