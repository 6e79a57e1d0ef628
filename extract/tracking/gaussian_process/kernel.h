#pragma once

#include <Eigen/Core>

#include "extract/tracking/gaussian_process/gait_process.h"

namespace stride::gaussian_process {

/// Instants of a group: times from the prior's origin, and the leg, 0 right or 1 left.
struct Instants {
  Eigen::ArrayXd time_s, left;
};

/// Covariance in units of the group's variance.
struct Covariance {
  GaitKernel k;
  bool paired;       // a joint of both legs, else a part of the trunk
  double drift = 0;  // variance of the trunk's path, the camera's drift with it

  /// Of every instant of a (rows) with every one of b (columns).
  Eigen::MatrixXd operator()(const Instants& a, const Instants& b) const;
  /// Variance at one instant.
  double at(double time_s) const;
};

}  // namespace stride::gaussian_process
