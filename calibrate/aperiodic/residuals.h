#pragma once

// The residuals of the fit of a passage, each with its formula. Blocks: limbs, four control points
// of the angles, the pelvis of a frame; px of an image in which the runner faces right and y is up.
// The marked pelvis is fit::PelvisResidual.

#include "calibrate/aperiodic/passage.h"

namespace stride::aperiodic {

/// A marked point z of a part: r = (p + q(Σ w_k c_k) − z) / σ with the pelvis p of this frame, the
/// part q of the runner from the pelvis, and the control points c that matter at this time.
struct PassagePointResidual {
  BodyPart part;
  Directions directions;
  std::array<double, 4> weight;
  Eigen::Vector2d z_px;
  double sigma_px;

  template <typename T>
  bool operator()(const T* limbs, const T* c0, const T* c1, const T* c2, const T* c3,
                  const T* pelvis_px, T* r) const {
    std::array<T, kAngles> angles;
    for (int a = 0; a < kAngles; ++a)
      angles[a] = weight[0] * c0[a] + weight[1] * c1[a] + weight[2] * c2[a] + weight[3] * c3[a];
    const Vector2<T> q = about_pelvis<T>(part, directions, limbs, angles);
    r[0] = (pelvis_px[0] + q.x() - z_px.x()) / sigma_px;
    r[1] = (pelvis_px[1] + q.y() - z_px.y()) / sigma_px;
    return true;
  }
};

/// Prior on the smoothness of the angles: second difference of the control points over its
/// standard deviation, that of the angular acceleration times the square of their spacing.
struct BendResidual {
  Angles sd_rad;

  template <typename T>
  bool operator()(const T* before, const T* here, const T* after, T* r) const {
    for (int a = 0; a < kAngles; ++a) r[a] = (before[a] - 2.0 * here[a] + after[a]) / sd_rad[a];
    return true;
  }
};

/// Limits of the joints, and priors on a control point, which bounds the spline:
///   r = max(0, min − c, c − max) / sd of each joint; (tilt − mean) / sd; (right − left) / sd
struct PostureResidual {
  struct Range {
    double min, max;
  };
  std::array<Range, 3> joints;  // hip, knee, ankle
  double limit_sd_rad;
  double tilt_mean_rad, tilt_sd_rad;
  double legs_sd_rad;  // of the difference of the legs

  template <typename T>
  bool operator()(const T* c, T* r) const {
    for (int i = 0; i < 6; ++i) {
      const Range& range = joints[static_cast<std::size_t>(i % 3)];
      const T& q = c[hip_r + i];
      r[i] = T(0);
      if (q > range.max) r[i] = (q - range.max) / limit_sd_rad;
      if (q < range.min) r[i] = (range.min - q) / limit_sd_rad;
    }
    r[6] = (c[tilt] - tilt_mean_rad) / tilt_sd_rad;
    for (int i = 0; i < 3; ++i) r[7 + i] = (c[hip_r + i] - c[hip_l + i]) / legs_sd_rad;
    return true;
  }
};

/// Weak priors on the limbs: r = (ln (thigh / shank)) / 0.15, ln (foot / shank / 0.47) / 0.5,
/// ln (trunk / leg / 0.87) / 0.3, depth / 0.025, as for a stride (fit/solver/priors.cpp).
struct LimbsResidual {
  template <typename T>
  bool operator()(const T* limbs, T* r) const {
    using std::log;
    r[0] = log(limbs[limb::thigh] / limbs[limb::shank]) / 0.15;
    r[1] = log(limbs[limb::foot] / limbs[limb::shank] / 0.47) / 0.5;
    r[2] = log(limbs[limb::trunk] / (limbs[limb::thigh] + limbs[limb::shank]) / 0.87) / 0.3;
    r[3] = limbs[limb::depth] / 0.025;
    return true;
  }
};

}  // namespace stride::aperiodic
