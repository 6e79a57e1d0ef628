#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calibrate/runner/sagittal_model.h"
#include "train/simulation/competition/rules.h"

namespace stride::environment {

/// What a competitor can make of the 41 observed values alone, and trust under the competition's
/// rules:
///
/// - `ankle_r_x`, `_y`, `toe_r_x`, `_y` and of the left: placed by pelvis and joint angles, for
///   observed bodies may be late; x from the pelvis, y above the ground;
/// - `strength_glut_max_r` …: strengths by the muscles that they scale (O3), so that a mirrored
///   runner is one that exists;
/// - obstacles, every one that was once observed: `obstacle_near_x` from the pelvis to the near
///   side of the next one and `obstacle_top_y`; for each foot and the next one that it has not left
///   behind `toe_r_to_near_side`, `ankle_r_to_far_side`, `toe_r_above_top`, `ankle_r_above_top`.
///   Distances are clipped to kObstacleRange_m; with none in range the obstacle is kObstacleRange_m
///   away and flat. Under nips2017 obstacles are as large as they collide, not as observed (O4).
class RobustFeatures {
 public:
  static constexpr double kObstacleRange_m = 3;

  RobustFeatures(const osim::Model& model, competition::Rules rules);

  static const std::vector<std::string>& names();

  /// A new episode: nothing is remembered.
  void start() { obstacles_.clear(); }
  /// Takes in every observation of an episode, for the competition shows one obstacle at a time,
  /// and writes names().size() values.
  void read(const Eigen::VectorXd& observation, double* values);

 private:
  void remember(const Eigen::VectorXd& observation);
  /// The first obstacle whose far side is not behind x, if its near side is in range of the pelvis.
  const simulation::Obstacle* next(double x, double pelvis_x) const;

  SagittalModel model_;
  competition::Rules rules_;
  std::vector<simulation::Obstacle> obstacles_;  // by x, of the size they collide with
};

}  // namespace stride::environment
