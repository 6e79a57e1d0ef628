#pragma once

#include <Eigen/Core>
#include <array>
#include <random>

namespace stride::environment {

/// OpenSim's competition observed the positions of head, torso, toes and ankles of an earlier
/// moment now and then (O6): all six at once, never the pelvis. Measured while running: 9 to 17 %
/// of the rows, in clusters, 1 to 5 steps old. Here a cluster begins with probability kBegin at
/// each step and freezes the positions for 1 to 5 steps.
class LatePositions {
 public:
  static constexpr double kBegin = 0.05;  // 1 in 7.7 rows is late
  static constexpr int kLongest = 5;      // steps

  /// A new episode; the clusters depend on its seed alone.
  void start(std::uint64_t seed);
  /// Replaces the positions in the competition's observation of the next step.
  void apply(Eigen::VectorXd& observation);

 private:
  std::mt19937_64 random_;
  int remaining_ = 0;     // steps of the cluster
  bool late_ = false;     // the last row was
  bool first_ = true;     // there is no earlier moment
  Eigen::VectorXd last_;  // positions as observed before
};

}  // namespace stride::environment
