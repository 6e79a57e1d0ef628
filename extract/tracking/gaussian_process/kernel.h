#pragma once

#include <Eigen/Core>

#include "extract/tracking/gaussian_process/gait_process.h"

namespace stride::gaussian_process {

/// Times of a group from the prior's origin, and the leg of each, 0 right or 1 left.
struct Instants {
  Eigen::ArrayXd time_s, left;
};

/// The covariance function, in units of the group's variance.
struct Covariance {
  GaitKernel k;
  bool paired;       // a joint of both legs, else a part of the trunk
  double drift = 0;  // variance of the trunk's path including the camera's drift

  /// Covariance of every time of a (rows) with every time of b (columns).
  Eigen::MatrixXd operator()(const Instants& a, const Instants& b) const;
  /// Variance at one time.
  double at(double time_s) const;
};

}  // namespace stride::gaussian_process
