#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "shaping/potential.h"

namespace stride::environment {

/// The result of one step. An episode ends in one of two ways: a terminated state has no future
/// (value 0, Φ = 0); a truncated one would continue, so its value is bootstrapped and its Φ is
/// kept.
struct Step {
  Eigen::VectorXd observation;  // of the state after the step
  double reward = 0;
  bool terminated = false;  // the runner fell, or its state could not be integrated
  bool truncated = false;   // time limit or task done; never together with `terminated`
  bool failed = false;      // terminated because the state could not be integrated
};

/// What a learner has to know about an environment.
struct EnvironmentSpec {
  /// One name for each element, in order. The part `_r` or `_l` of a name tells right from left
  /// (`knee_angle_r`, `talus_l_vx`): mirroring in the sagittal plane swaps the two elements and
  /// leaves every other one as it is.
  std::vector<std::string> observation_names;
  std::vector<std::string> action_names;
  double step_s = 0.01;  // simulated time of one step
  int max_steps = 1000;  // the time limit, in steps
};

/// An environment for reinforcement learning. Not thread-safe; environments share nothing.
///
/// Deterministic: the same seed and actions give the same steps, bit by bit, whatever happened
/// before reset(seed). Checkpoints rely on this: they store the seed and the actions of the running
/// episode and repeat them.
///
/// The runner's observation: first the competition's 41 in its order, in the ground's axes, not
/// centred; then what the features of the paper are made of: `_vx`, `_vy` of head, torso, toes_l,
/// toes_r, talus_l, talus_r; `_x`, `_y`, `_vx`, `_vy` of tibia (its origin: the knee) and calcn
/// (the heel), `_l` and `_r`: `tibia_r_x`; then `activation_` and the name of each muscle. SI and
/// rad. Every point has the names `<point>_x`, `_y`, `_vx`, `_vy`: pelvis and com, too.
class Environment {
 public:
  virtual ~Environment() = default;

  virtual const EnvironmentSpec& spec() const = 0;

  /// Starts the episode of that seed. The reference stays valid until the next reset() or step().
  virtual const Eigen::VectorXd& reset(std::uint64_t seed) = 0;

  /// One step under `action`, each element clipped to [0, 1]. Never throws; not to be called after
  /// the end of an episode. The reference stays valid until the next reset() or step().
  virtual const Step& step(const Eigen::VectorXd& action) = 0;

  /// The pose of the current state, for the potential.
  virtual Pose pose() const = 0;

  /// How fast its parts move, m/s.
  virtual Pose pose_velocity() const = 0;

  MovingPose motion() const { return {pose(), pose_velocity()}; }

  /// Simulated time since reset(), and the measure of the task since then: of a run the distance
  /// that the pelvis covered.
  virtual double time_s() const = 0;
  virtual double distance_m() const = 0;

  /// Phase of the stride after reset(): 0 unless the initial state was drawn from a reference
  /// motion.
  virtual double initial_phase() const { return 0; }
};

}  // namespace stride::environment
