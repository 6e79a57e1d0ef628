#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "train/ddpg/agent.h"
#include "train/ddpg/explorer.h"
#include "train/training/options.h"
#include "train/training/thread_pool.h"

namespace stride::training {

/// Makes environment number `slot` of a run; slot < 0: the one for evaluation, whose episodes start
/// by the rules.
using EnvironmentFactory = std::function<std::unique_ptr<environment::Environment>(int slot)>;

/// Counters of a run, and sums since the last row of the curve.
struct Progress {
  std::int64_t decisions = 0, updates = 0, episodes = 0, falls = 0, failures = 0;
  std::int64_t rows = 0;                // of curve.csv
  std::int64_t last_row_decisions = 0;  // decisions in the last of them
  std::int64_t next_evaluation = 0;     // in decisions
  double best_distance_m = -1e300;      // of an evaluation

  struct Sums {
    double episodes = 0, distance_m = 0, reward = 0;
    double updates = 0, critic_loss = 0, q = 0, target = 0, actor_gradient = 0, critic_gradient = 0;
  } sums;

  /// Counts an episode of training that has ended.
  void add(const network::EpisodeSummary& episode);
};

/// The mutable state of a run, which a checkpoint stores.
template <typename Scalar>
struct Training {
  std::vector<std::string> feature_names, action_names;
  double step_s;
  Random random;  // of the learner
  ddpg::Agent<Scalar> agent;
  network::Normaliser normaliser;
  ddpg::ReplayBuffer<Scalar> buffer;
  std::vector<ddpg::Explorer<Scalar>> explorers;
  Progress progress;
};

/// Starts a run. `potential` may be null and must outlive the training.
template <typename Scalar>
Training<Scalar> start_training(const TrainOptions& options, const Potential* potential,
                                const EnvironmentFactory& make_environment);

/// A copy of the current policy.
template <typename Scalar>
network::Policy<Scalar> policy_of(const Training<Scalar>& training, const TrainOptions& options);

template <typename Scalar>
double simulated_s(const Training<Scalar>& training);

/// The agent's view of an environment under these options.
environment::Observer make_observer(const TrainOptions& options, const Potential* potential,
                                    const environment::EnvironmentSpec& spec);

/// Evaluates an agent without noise, in episodes that start by the rules. Each thread has an
/// environment of its own.
class Evaluator {
 public:
  Evaluator(const TrainOptions& options, const Potential* potential,
            const EnvironmentFactory& make_environment, int threads);

  template <typename Scalar>
  std::vector<network::EpisodeSummary> evaluate(const network::Policy<Scalar>& policy,
                                                ThreadPool& threads);

 private:
  const TrainOptions& options_;
  const Potential* potential_;
  std::vector<std::unique_ptr<environment::Environment>> environments_;
  std::vector<environment::Observer> observers_;
};

}  // namespace stride::training
