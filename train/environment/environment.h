#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "shaping/potential.h"

namespace stride::environment {

/// What one step did. An episode ends in one of two ways, and they mean different things to a
/// learner: a terminated state has no future (value 0, Φ = 0); a truncated one goes on unseen, so
/// its value is bootstrapped and its Φ is kept.
struct Step {
  Eigen::VectorXd observation;  // of the state after the step
  double reward = 0;
  bool terminated = false;  // the runner fell, or its state could not be integrated
  bool truncated = false;   // the time limit was reached; never together with `terminated`
  bool failed = false;      // terminated because the state could not be integrated
};

/// What an environment is, as far as a learner has to know.
struct EnvironmentSpec {
  /// One name an element, in order. Left and right are told by a part `_r` or `_l` of the name
  /// (`knee_angle_r`, `talus_l_vx`): mirroring in the sagittal plane swaps the two elements and
  /// leaves every other one as it is.
  std::vector<std::string> observation_names;
  std::vector<std::string> action_names;
  double step_s = 0.01;  // simulated time of one step
  int max_steps = 1000;  // the time limit, in steps
};

/// Something that learns by steps. One thread at a time; two environments share nothing.
///
/// Deterministic: reset(seed) forgets everything before it, and the same seed followed by the same
/// actions gives the same steps, bit by bit. Training resumes by this: a checkpoint keeps the seed
/// and the actions of the running episode and repeats them.
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

  /// Of the current state: what the potential compares.
  virtual Pose pose() const = 0;

  /// Simulated time since reset(), and the distance covered since then (of the pelvis).
  virtual double time_s() const = 0;
  virtual double distance_m() const = 0;

  /// Phase of the stride into which reset() put the runner: 0 unless the initial state was drawn
  /// from a reference motion.
  virtual double initial_phase() const { return 0; }
};

}  // namespace stride::environment
