#pragma once

#include <vector>

#include "calibrate/runner/calibrated.h"
#include "train/environment/runner_environment.h"
#include "train/network/policy.h"

namespace stride::rollout {

/// One frame of an episode.
struct RolloutFrame {
  simulation::RunnerState state;
  simulation::RunnerKinematics kinematics;
  simulation::Excitations excitations{};  // that led here; 0 in the first
  double phase = 0;                       // of the potential's stride; 0 without one
};

/// An episode, with a frame for each step.
struct Rollout {
  network::EpisodeSummary summary;
  std::vector<simulation::Obstacle> obstacles;
  std::vector<RolloutFrame> frames;
};

template <typename Scalar>
Rollout record_episode(const network::Policy<Scalar>& policy,
                       environment::RunnerEnvironment& environment, environment::Observer& observer,
                       const Potential* potential, int action_repeat, std::uint64_t seed);

/// The part of a rollout from `from_s` on as a demonstration. Throws Error with the cure if it
/// holds fewer than two strides of the right foot.
CalibratedTrajectory demonstration(const Rollout& rollout, const osim::Model& model, double from_s);

/// OpenSim's storage files: coordinates (.mot), or all states (.sto), rad and m.
std::string motion_file(const Rollout& rollout);
std::string states_file(const Rollout& rollout);

}  // namespace stride::rollout
