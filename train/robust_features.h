#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calibrate/sagittal_model.h"
#include "train/simulation/rules.h"

namespace stride {

/// What can be made of the competition's 41 values alone that holds under its rules:
///
/// - pelvis, joints and centre of mass as they are observed, x from the pelvis;
/// - ankles and toes placed by the joint angles, for observed bodies may be late;
/// - strengths by the muscles that they scale, right and left, so that a mirrored runner is one
///   that exists;
/// - every obstacle that was once the next: from the pelvis to its near side, and for each foot
///   from the toe to the near side and from the ankle to the far side of the next one that the foot
///   has not left behind, and how far both are above its top. Distances are clipped to
///   kSight_m; beyond it, or with nothing ahead, an obstacle counts as flat and kSight_m away.
///   Under nips2017 obstacles are as large as they collide, not as observed (O4).
class RobustFeatures {
 public:
  static constexpr double kSight_m = 3;

  RobustFeatures(const Model& model, Rules rules);

  const std::vector<std::string>& names() const { return names_; }
  /// A new episode: nothing is remembered.
  void start() { obstacles_.clear(); }
  /// Every observation of an episode, also those between two decisions: the competition shows one
  /// obstacle at a time.
  void watch(const Eigen::VectorXd& observation);
  /// Writes names().size() values for the observation that was watched last.
  void write(const Eigen::VectorXd& observation, double* values) const;

 private:
  /// The first obstacle whose far side is not behind x; null: none is known.
  const Obstacle* next(double x) const;

  SagittalModel model_;
  Rules rules_;
  std::vector<std::string> names_;
  std::vector<Obstacle> obstacles_;  // in the order of x, of the size they collide with
};

}  // namespace stride
