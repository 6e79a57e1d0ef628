#pragma once

#include <array>
#include <vector>

#include "calibrate/runner/calibrated.h"
#include "train/simulation/engine/engine.h"

namespace stride::environment {

/// A reward for moving as the clip does at the clip's time, after Peng et al. 2018 (DeepMimic). It
/// is no difference of potentials: what is optimal changes with it.
struct ImitationOptions {
  double reward_per_s = 0;  // of each simulated second like the clip's; 0: none
  double angle_deg = 12;    // root mean square of the difference that leaves 1/e
  /// A training episode ends as by a fall where the difference is larger than that; 0: never.
  double end_deg = 0;

  bool operator==(const ImitationOptions&) const = default;
};

/// The clip's motion as a function of phase.
class Imitation {
 public:
  /// Of strides the mean. The clip has three samples at least.
  Imitation(const CalibratedTrajectory& clip, const ImitationOptions& options);

  /// 0.8 exp(−mean Δθ² / angle²) + 0.2 exp(−mean Δω² / (3 rad/s)²), with the differences of the
  /// angles θ and rates ω of pelvis, hips, knees and ankles to the clip's at that phase: 1 for the
  /// clip's own motion.
  double similarity(const simulation::RunnerState& state, double phase) const;

  double reward(const simulation::RunnerState& state, double phase, double step_s) const {
    return options_.reward_per_s * step_s * similarity(state, phase);
  }

  /// Whether an episode ends there.
  bool ends(const simulation::RunnerState& state, double phase) const;

  /// Phase of the clip's movement `time_s` after `initial_phase`.
  double phase_at(double initial_phase, double time_s) const;

 private:
  static constexpr std::array kAngles{simulation::kPelvisTilt, simulation::kHipRight,
                                      simulation::kKneeRight,  simulation::kAnkleRight,
                                      simulation::kHipLeft,    simulation::kKneeLeft,
                                      simulation::kAnkleLeft};
  using Angles = std::array<double, kAngles.size()>;  // rad, or rad/s

  struct Knot {
    double phase = 0;
    Angles angle{}, rate{};
  };

  Knot at(double phase) const;

  ImitationOptions options_;
  bool repeats_;
  double period_s_;
  std::vector<Knot> knots_;  // in the order of phase
};

}  // namespace stride::environment
