#pragma once

#include <array>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "calibrate/runner/calibrated.h"
#include "train/environment/environment.h"
#include "train/environment/imitation.h"
#include "train/environment/late_positions.h"
#include "train/environment/robust_features.h"
#include "train/simulation/competition/rules.h"
#include "train/simulation/competition/sensors.h"
#include "train/simulation/make_engine.h"
#include "train/task/task.h"

namespace stride::environment {

struct RunnerOptions {
  std::string engine = simulation::kDefaultEngine;
  competition::Rules rules = competition::Rules::clean;
  int difficulty = 0;     // 0: flat; 1: obstacles; 2: obstacles and weak muscles
  int max_obstacles = 3;  // 0 to 20
  double accuracy = 1e-3;
  int max_steps = 0;           // 0: the time limit of the task
  task::TaskOptions task;      // reward, end and measure
  std::string foot = "ankle";  // of pose(): "ankle" (origin of talus) or "toe" (of toes)
  /// Reference state initialisation: this share of the episodes starts from a random sample of a
  /// calibrated run, with its speeds and with fibres in equilibrium whatever the rules. The runner
  /// is raised where a foot would be deeper in the floor than in standing.
  std::optional<CalibratedTrajectory> reference;
  double reference_share = 1;
  ImitationOptions imitation;  // of the reference
  /// Of the episodes have no obstacles, and at most three, whatever the difficulty says.
  double flat_share = 0, few_share = 0;
  /// Under nips2017: observed positions of bodies are late now and then (O6), see LatePositions.
  bool late_positions = true;
  /// Under nips2017, false only to find out what they do: O1 and O2 of competition::Rules.
  bool raw_fibres = true, drop_contacts = true;
  double drop_share = 1;  // of the force of a contact after one that pulls
  /// What a knee that bends backward takes from the reward, m/s per rad; 0 in the competition. The
  /// model's knees have springs from 10° on, on which an agent runs with straight legs.
  double backward_knees = 0;
};

/// "Learning to Run": nine degrees of freedom, eighteen muscles, obstacles; observation as in
/// the competition (see Sensors, Rules), reward and end of an episode as in the task, by default
/// the competition's. What is done ends an episode as the time limit does: the runner stands on. An
/// action is the excitation of each muscle for 0.01 s.
class RunnerEnvironment final : public Environment {
 public:
  /// Throws Error naming the option that is out of range, or why the engine refuses the model.
  RunnerEnvironment(const osim::Model& model, const RunnerOptions& options);

  const EnvironmentSpec& spec() const override { return spec_; }
  const Eigen::VectorXd& reset(std::uint64_t seed) override;
  const Step& step(const Eigen::VectorXd& action) override;
  Pose pose() const override;
  Pose pose_velocity() const override;
  double time_s() const override { return engine_->state().time_s; }
  double distance_m() const override { return task_->measure_m(); }
  double initial_phase() const override { return initial_phase_; }

  const simulation::Engine& engine() const { return *engine_; }
  const competition::Scene& scene() const { return scene_; }
  /// For the current state.
  const simulation::RunnerKinematics& kinematics() const { return kinematics_; }
  /// For the last step.
  const competition::Reward& reward() const { return reward_; }
  const simulation::AdvanceReport& report() const { return report_; }

  /// Counts how the episodes since construction ended; those that were cut off by reset() are
  /// `abandoned`.
  struct Tally {
    long steps = 0, episodes = 0;
    long falls = 0, time_limits = 0, failures = 0, abandoned = 0;
  };
  const Tally& tally() const { return tally_; }

 private:
  void start_on_reference(std::mt19937_64& random);
  void observe();
  void thin_out(std::mt19937_64& random);

  using Frame = simulation::RunnerKinematics::Frame;
  using Coordinates = std::array<double, simulation::kCoordinates>;

  /// Places or velocities of the pose's parts less the pelvis', of which `pelvis` is q or u.
  Pose from_pelvis(simulation::PlanarVector Frame::*what, const Coordinates& pelvis) const;

  RunnerOptions options_;
  EnvironmentSpec spec_;
  std::unique_ptr<simulation::Engine> engine_;
  std::unique_ptr<task::Task> task_;
  std::optional<Imitation> imitation_;
  competition::Sensors sensors_;
  LatePositions late_positions_;
  RobustFeatures robust_features_;
  bool legs_together_;
  int knee_r_, knee_l_, foot_r_, foot_l_;  // indices into Model::bodies

  competition::Scene scene_;
  simulation::RunnerKinematics kinematics_;
  competition::Reward reward_;
  simulation::AdvanceReport report_;
  Step step_;
  Tally tally_;
  int steps_ = 0;
  bool running_ = false;
  double initial_phase_ = 0;
};

}  // namespace stride::environment
