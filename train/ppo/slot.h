#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "shaping/potential.h"
#include "train/environment/environment.h"
#include "train/environment/mirror.h"
#include "train/environment/observation.h"
#include "train/network/policy.h"
#include "train/ppo/rollout_batch.h"

namespace stride::ppo {

/// The state of a slot between decisions, as in a checkpoint. It does not contain the environment,
/// which is restored by repeating the episode's actions.
struct SlotState {
  Random random;
  bool running = false;
  std::uint64_t episode_seed = 0;
  std::vector<std::uint8_t> actions;  // as applied in the episode so far
  network::EpisodeSummary episode;
  double simulated_s = 0;  // since the run began
};

/// One environment with what belongs to it. Slots share nothing that changes.
class Slot {
 public:
  struct Setup {
    int action_repeat = 3;
    double gamma = 0.99;                   // of the shaping reward
    const Potential* potential = nullptr;  // null: no shaping
    double fall_reward = 0;
  };

  Slot(std::unique_ptr<environment::Environment> environment, environment::Observer observer,
       const Setup& setup, std::uint64_t seed);

  /// Features of the current state; starts an episode where none is running.
  const Eigen::VectorXd& features();

  struct DecisionResult {
    float reward = 0;
    EpisodeEnd end = EpisodeEnd::none;
  };
  /// Draws an action from the logits into `action`, and repeats it, or with `mirror` its mirror
  /// image. `alive_per_s`: reward of each simulated second. After the end of an episode features()
  /// is the end's until begin_next().
  DecisionResult decide(const Eigen::Ref<const Vector>& logits, double alive_per_s,
                        Eigen::Ref<Vector> action, const environment::Mirror* mirror = nullptr);
  void begin_next();

  std::vector<network::EpisodeSummary> take_finished();

  const std::vector<network::EpisodeSummary>& finished() const { return finished_; }

  /// Of a slot that another rank steps: what it tells of it.
  void take_over(double simulated_s, std::vector<network::EpisodeSummary> finished) {
    state_.simulated_s = simulated_s;
    finished_ = std::move(finished);
  }
  void take_over(const SlotState& state) { state_ = state; }

  const SlotState& state() const { return state_; }
  void restore(const SlotState& state);

 private:
  void reset();
  DecisionResult repeat(double alive_per_s);
  double phase() const;
  double potential() const;

  std::unique_ptr<environment::Environment> environment_;
  environment::Observer observer_;
  Setup setup_;
  SlotState state_;
  std::vector<network::EpisodeSummary> finished_;
  Eigen::VectorXd features_, applied_;
};

}  // namespace stride::ppo
