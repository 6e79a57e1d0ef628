#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "extract/skeleton/body_part.h"
#include "extract/skeleton/stride_period.h"

namespace stride::gaussian_process {

/// Position of a part at a time, or its displacement since an earlier time, with the variance of
/// each coordinate.
struct Observation {
  double time_s = 0;
  Eigen::Vector2d p_px = Eigen::Vector2d::Zero();  // position, or displacement since `since_s`
  Eigen::Vector2d variance_px2 = Eigen::Vector2d::Ones();
  double since_s = std::numeric_limits<double>::quiet_NaN();

  bool is_displacement() const { return since_s == since_s; }
};
using Observations = std::array<std::vector<Observation>, kBodyPartCount>;

struct Estimate {
  Eigen::Vector2d p_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d variance_px2 = Eigen::Vector2d::Zero();
};

/// The motion of a runner's parts as a Gaussian process (Rasmussen & Williams 2006), the sum of
///
///     a periodic motion shared by both legs, the left half a period later     variance 1
///     a periodic motion of one leg                                            asymmetry²
///     a motion that is not periodic                                           residual²
///
/// in units of the part's variance. Strides clicked at different phases fill each other's gaps;
/// with no periodic motion the regression becomes a smoothing spline.
///
/// Of a movement that does not repeat (`periodic` false) it is the sum of
///
///     a motion shared by both legs                                            residual²
///     a motion of one leg                                                     asymmetry²
///
/// of the correlation time residual_strides; a "stride" is then period_s, which is no unknown.
struct GaitKernel {
  bool periodic = true;
  double period_s = 0.75;     // of a stride, i.e. two steps
  double amplitude = 1;       // of the trunk, relative to the usual one; unused for legs
  double length_scale = 0.6;  // correlation length within the stride, as in exp(−2 sin²/ℓ²)
  double coherence_strides = 20;  // correlation time of the periodic motion, in strides
  double asymmetry = 0.3;
  double residual = 0.15;
  double residual_strides = 0.15;  // correlation time of the other motion, in strides
  double noise_px = 0.7;           // standard deviation of a click, each coordinate
};

struct GaitPrior {
  GaitKernel legs, trunk;  // trunk: pelvis and head, periodic in a step
  double origin_s = 0;     // middle of the clicks
  double size_px = 90;     // rms distance of knees, ankles and toes from the pelvis
};

using Estimates = std::vector<std::array<Estimate, kBodyPartCount>>;

}  // namespace stride::gaussian_process
