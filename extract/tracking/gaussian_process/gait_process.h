#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "extract/skeleton/body_part.h"
#include "extract/skeleton/stride_period.h"

namespace stride::gaussian_process {

/// Where a part was seen at a time, or how far it moved since an earlier one, with the variance of
/// each coordinate.
struct Observation {
  double time_s = 0;
  Eigen::Vector2d p_px = Eigen::Vector2d::Zero();  // the place, or the way since `since_s`
  Eigen::Vector2d variance_px2 = Eigen::Vector2d::Ones();
  double since_s = std::numeric_limits<double>::quiet_NaN();

  bool is_displacement() const { return since_s == since_s; }
};
using Observations = std::array<std::vector<Observation>, kBodyPartCount>;

struct Estimate {
  Eigen::Vector2d p_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d variance_px2 = Eigen::Vector2d::Zero();
};

/// How a runner's parts move, as a Gaussian process (Rasmussen & Williams, 2006): the sum of
///
///     a stride that repeats, the left leg half a period behind the right      variance 1
///     what one leg does differently, repeating too                            asymmetry²
///     what does not repeat                                                    residual²
///
/// in units of the part's own variance. Where strides were clicked at different phases they fill
/// one another's gaps; where nothing repeats it becomes a smoothing spline.
struct GaitKernel {
  double period_s = 0.75;  // of a stride: two steps
  double amplitude = 1;    // of what repeats in the trunk, in units of what is usual; legs: unused
  double length_scale = 0.6;  // correlation length within the stride, as in exp(−2 sin²/ℓ²)
  double coherence_strides = 20;  // after how many strides the repetition is forgotten
  double asymmetry = 0.3;
  double residual = 0.15;
  double residual_strides = 0.15;  // correlation length of what does not repeat
  double noise_px = 0.7;           // standard deviation of a click, each coordinate
};

struct GaitPrior {
  GaitKernel legs, trunk;  // trunk: pelvis and head, which repeat every step
  double origin_s = 0;     // middle of the clicks
  double size_px = 90;     // rms distance of knees, ankles and toes from the pelvis
};

using Estimates = std::vector<std::array<Estimate, kBodyPartCount>>;

}  // namespace stride::gaussian_process
