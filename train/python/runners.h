#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shaping/potential.h"
#include "train/environment/observation.h"
#include "train/environment/runner_environment.h"
#include "train/training/thread_pool.h"

namespace stride::python {

struct RunnersOptions {
  environment::RunnerOptions runner = {};
  std::string model;  // .osim; empty: the model of Learning to Run
  /// "competition": its 41 values; "all": every sensor; "agent": the features of `features`.
  std::string observation = "competition";
  environment::ObservationOptions features = {};
  int action_repeat = 1;               // steps of 0.01 s that an action is held
  std::optional<Potential> potential;  // gives the phase, Φ and what a foot is
  int count = 1, threads = 1;          // runners; threads ≤ 0: one a core
};

/// Where a step of all runners is written; an element, or a row, a runner. Row-major.
struct StepArrays {
  std::span<double> observations, rewards, forward, ligament, distances_m, times_s, phases, phis;
  std::span<double> poses;  // 9 a runner
  std::span<bool> terminated, truncated, failed;
};

/// Runners that step side by side in threads. Runner i of n lives through the episodes of the
/// seeds s + i, s + i + n, s + i + 2 n, … after reset(s): each is the episode that an Environment
/// of that seed gives. After the end of an episode the next step() ignores the action and starts
/// the next one, with a reward of 0 (Gymnasium's "next step" autoreset).
class Runners {
 public:
  /// Throws Error naming the option that is out of range.
  explicit Runners(const RunnersOptions& options);

  const std::vector<std::string>& observation_names() const { return observation_names_; }
  const std::vector<std::string>& action_names() const { return action_names_; }
  int count() const { return static_cast<int>(runners_.size()); }

  /// All runners. `arrays` are of count() elements or rows.
  void reset(std::uint64_t seed, const StepArrays& arrays);
  /// Actions: count() rows of 18. They must be finite.
  void step(std::span<const double> actions, const StepArrays& arrays);

  /// One runner with a seed of its own.
  void reset_one(int runner, std::uint64_t seed, const StepArrays& arrays);

  const environment::RunnerEnvironment& environment(int runner) const;

 private:
  struct Runner;
  void start(Runner& runner, std::size_t i, const StepArrays& arrays);
  void advance(Runner& runner, std::size_t i, std::span<const double> action,
               const StepArrays& arrays);
  void write(Runner& runner, std::size_t i, const Eigen::VectorXd& observation, bool first,
             const StepArrays& arrays);

  RunnersOptions options_;
  std::vector<std::string> observation_names_, action_names_;
  std::vector<std::shared_ptr<Runner>> runners_;
  training::ThreadPool pool_;
};

}  // namespace stride::python
