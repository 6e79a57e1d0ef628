#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "train/environment/environment.h"

namespace stride::environment {

/// How a phase is told: by sine and cosine that change their sign as legs in turn are mirrored, by
/// sine and cosine that do not, or as it is, from 0 to 1.
enum class PhaseAs { phase_of_turns, cycle, passage };

struct ObservationOptions {
  bool robust = false;      // what RobustFeatures makes of the 41, instead of the late and the rest
  bool centre = true;       // x positions are measured from the pelvis
  bool derived = false;     // the 71 features that the paper adds to the competition's 41
  bool activations = true;  // of the runner's own muscles
  bool phase = true;        // sine and cosine of the phase of the stride
  PhaseAs phase_as = PhaseAs::phase_of_turns;

  bool operator==(const ObservationOptions&) const = default;
};

/// The agent's view of the environment: 41 → 112 features as in the paper (Sec. "State
/// representation"), which does not list its features; only their number is the same. The 71: of
/// ten points (head, torso, knees, ankles, heels, toes) the position relative to the pelvis, the
/// velocity and the acceleration; the accelerations of pelvis and centre of mass; the angular
/// accelerations of pelvis, hips, knees and ankles. Knee, ankle and heel are the origins of tibia,
/// talus and calcn. An acceleration is the difference of two velocities one decision apart, 0 in
/// the first observation of an episode.
class Observer {
 public:
  /// `decision_s`: simulated time between two observations. Throws Error naming what the
  /// environment does not observe.
  Observer(const EnvironmentSpec& spec, const ObservationOptions& options, double decision_s);

  const std::vector<std::string>& names() const { return names_; }

  /// The first observation of an episode.
  void start(const Eigen::VectorXd& observation, double phase, Eigen::VectorXd& features);
  /// Each following observation, one decision later.
  void follow(const Eigen::VectorXd& observation, double phase, Eigen::VectorXd& features);

 private:
  void observe(const Eigen::VectorXd& observation, double phase, Eigen::VectorXd& features);

  struct Difference {
    int value, origin;  // indices; origin < 0: none
  };

  double decision_s_;
  bool phase_;
  PhaseAs phase_as_;
  std::vector<std::string> names_;
  std::vector<Difference> taken_;  // features that are elements, or differences of two
  std::vector<int> rates_;         // velocities whose change is a feature
  Eigen::VectorXd last_rates_;
};

/// Number of the competition's observations, the first elements of the runner's.
inline constexpr int kCompetitionObservations = 41;

}  // namespace stride::environment
