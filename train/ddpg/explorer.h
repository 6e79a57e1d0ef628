#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "shaping/potential.h"
#include "train/ddpg/ornstein_uhlenbeck.h"
#include "train/ddpg/replay_buffer.h"
#include "train/environment/environment.h"
#include "train/environment/observation.h"
#include "train/network/policy.h"

namespace stride::ddpg {

struct ExplorationOptions {
  double sigma = 0.4, final_sigma = 0.1;  // of the Ornstein–Uhlenbeck noise on actions
  double decay_decisions = 3e6;           // from one to the other, linearly
  double theta = 0.1;                     // its pull back to 0 a decision; 1: white
  double sigma_ratio = 2;                 // environments differ in sigma by up to this factor
  double noise_free_fraction = 0.05;      // of episodes have no noise
  double parameter_share = 0.4;     // of episodes have noise on the actor's parameters instead
  double parameter_distance = 0.2;  // root mean square change of actions that it aims at
};

/// The state of a slot between decisions, as in a checkpoint. It does not contain the environment,
/// which is restored by repeating the episode's actions.
template <typename Scalar>
struct ExplorerState {
  using Vector = typename network::Mlp<Scalar>::Vector;

  Random random;
  bool running = false;  // there is an episode
  bool over = false;     // it has ended, but is not recorded and replaced yet
  std::uint64_t episode_seed = 0;
  std::vector<Scalar> actions;  // of the episode so far, one after the other
  double sigma_factor = 0;      // of the episode's noise
  OuNoise noise;
  Vector perturbed;  // parameters of the episode's perturbed actor; empty: none
  network::EpisodeSummary episode;
  double simulated_s = 0;  // since the run began
};

/// One environment with its observer, action repeat, phase, noise and random numbers. Slots share
/// no mutable state, so the order in which threads serve them does not matter.
template <typename Scalar>
class Explorer {
 public:
  using Vector = typename network::Mlp<Scalar>::Vector;

  struct Setup {
    ExplorationOptions exploration = {};
    int action_repeat = 3;
    double sigma_factor = 1;               // this slot's factor on sigma
    const Potential* potential = nullptr;  // null: phase and Φ are 0
    double fall_reward = 0, alive_reward_per_s = 0;
  };

  Explorer(std::unique_ptr<environment::Environment> environment, environment::Observer observer,
           const Setup& setup, std::uint64_t seed);

  /// One round: a decision or, after the end of an episode, its last state and a reset. Writes the
  /// record, its features and its action.
  void decide(const network::Policy<Scalar>& policy, const ReplayBuffer<Scalar>& buffer,
              typename ReplayBuffer<Scalar>::Record& record, Eigen::Ref<Vector> features,
              Eigen::Ref<Vector> action);

  /// Episodes that ended since the last call.
  std::vector<network::EpisodeSummary> take_finished();

  const std::vector<network::EpisodeSummary>& finished() const { return finished_; }

  const ExplorerState<Scalar>& state() const { return state_; }
  /// Continues from a stored state.
  void restore(const ExplorerState<Scalar>& state);

  /// What another process did with this slot, where nobody decides here: the simulated time of the
  /// run and the episodes that ended; or its whole state, for a checkpoint.
  void take_over(double simulated_s, std::vector<network::EpisodeSummary> finished) {
    state_.simulated_s = simulated_s;
    finished_ = std::move(finished);
  }
  void take_over(const ExplorerState<Scalar>& state) { state_ = state; }

 private:
  void start_episode(const network::Policy<Scalar>& policy, const ReplayBuffer<Scalar>& buffer);
  void perturb(const network::Policy<Scalar>& policy, const ReplayBuffer<Scalar>& buffer);
  void reset();
  /// Repeats an action; returns the outcome and accumulates the reward.
  RecordKind repeat(const Eigen::Ref<const Vector>& action, double& reward);
  double phase() const;

  std::unique_ptr<environment::Environment> environment_;
  environment::Observer observer_;
  Setup setup_;
  ExplorerState<Scalar> state_;
  std::vector<network::EpisodeSummary> finished_;
  Eigen::VectorXd features_, applied_;  // features of the current state; the action in double
  typename network::Mlp<Scalar>::Matrix input_;
  typename network::Mlp<Scalar>::Workspace work_;
  network::Mlp<Scalar> perturbed_actor_{network::MlpShape{}};
};

extern template class Explorer<float>;
extern template class Explorer<double>;

}  // namespace stride::ddpg
