#pragma once

#include "extract/gait_prior.h"

namespace stride {

/// Covariance in units of the group's variance; times from the prior's origin.
struct Covariance {
  GaitKernel k;
  bool paired;       // a joint of both legs, else a part of the trunk
  double drift = 0;  // variance of the trunk's path, the camera's drift with it

  double operator()(double t, int t_left, double u, int u_left) const;
};

}  // namespace stride
