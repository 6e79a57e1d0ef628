#pragma once

// The residuals of the fit, each with its formula and the blocks of parameters it depends on.
// Pixels are those of an image in which the runner faces right and y is up.

#include "calibrate/fit/solver/blocks.h"

namespace stride::fit {

/// A marked point z of a part in the frame at u:
///   r = (p + e^{s + ṡu} R(ρ) q(φ(u)) − z) / σ
/// with the pelvis p of this frame in the image, px per metre e^s and its drift ṡ, the roll ρ, and
/// the part q of the runner from the pelvis. Two residuals. The place of a heel on the foot is
/// unknown: one block more, of size `kHeel`.
template <int... kHeel>
struct PartResidual {
  using DependsOn = Blocks<2, Others<2, kHeel...>, &Runner::camera, &Runner::cadence, &Runner::body,
                           &Runner::sides, &Runner::tilt, &Runner::hip, &Runner::knee,
                           &Runner::ankle, &Runner::asymmetry>;

  BodyPart part;
  Directions directions;
  int harmonics;
  double u_s;
  Eigen::Vector2d z_px;
  double sigma_px;

  template <typename T>
  bool operator()(const T* camera, const T* cadence, const T* body, const T* sides, const T* tilt,
                  const T* hip, const T* knee, const T* ankle, const T* asymmetry,
                  const T* pelvis_px, Block<T, kHeel>... heel, T* r) const {
    const T phase = phase_at(cadence, u_s);
    const auto leg =
        leg_angles(hip, knee, ankle, asymmetry, harmonics, side_of(part) < 0 ? -1 : 1, phase);
    at_pose(camera, body, sides, evaluate_series(tilt, kTiltHarmonics, phase), leg, phase,
            pelvis_px, heel..., r);
    return true;
  }

  /// The same for given phase and angles.
  template <typename T>
  void at_pose(const T* camera, const T* body, const T* sides, const T& tilt,
               const LegAngles<T>& leg, const T& phase, const T* pelvis_px, Block<T, kHeel>... heel,
               T* r) const {
    using std::exp;
    const Vector2<T> q = place_part(part, directions, body, sides, tilt, leg, phase, heel...);
    const T scale = exp(camera[camera::log_px_per_m] + camera[camera::drift_per_s] * u_s);
    const Vector2<T> offset = scale * turned(camera[camera::roll], q);
    r[0] = (pelvis_px[0] + offset.x() - z_px.x()) / sigma_px;
    r[1] = (pelvis_px[1] + offset.y() - z_px.y()) / sigma_px;
  }
};
using PointResidual = PartResidual<>;
using HeelResidual = PartResidual<heel::size>;

/// The marked pelvis itself: r = (p − z) / σ.
struct PelvisResidual {
  using DependsOn = Blocks<2, Others<2>>;

  Eigen::Vector2d z_px;
  double sigma_px;

  template <typename T>
  bool operator()(const T* pelvis_px, T* r) const {
    r[0] = (pelvis_px[0] - z_px.x()) / sigma_px;
    r[1] = (pelvis_px[1] - z_px.y()) / sigma_px;
    return true;
  }
};

/// Prior on the length of the runner's legs, which sets the scale: ln L ± sd.
///   r = (ln (thigh + shank) − ln L) / sd
struct LegLengthResidual {
  using DependsOn = Blocks<1, Others<>, &Runner::body>;

  double leg_m, relative_sd;

  template <typename T>
  bool operator()(const T* body, T* r) const {
    using std::log;
    r[0] = (log(body[body::thigh] + body[body::shank]) - std::log(leg_m)) / relative_sd;
    return true;
  }
};

/// Prior on a proportion: r = (ln (b_i / b_j) − ln ratio) / sd.
struct ProportionResidual {
  using DependsOn = Blocks<1, Others<>, &Runner::body>;

  int i, j;  // of `body`
  double ratio, relative_sd;

  template <typename T>
  bool operator()(const T* body, T* r) const {
    using std::log;
    r[0] = (log(body[i] / body[j]) - std::log(ratio)) / relative_sd;
    return true;
  }
};

/// Prior that the labelled pelvis is the midpoint of the hips: r = (hip offset) / sd. Two
/// residuals.
struct HipsResidual {
  using DependsOn = Blocks<2, Others<>, &Runner::body>;

  double sd_m;

  template <typename T>
  bool operator()(const T* body, T* r) const {
    r[0] = body[body::hip_x] / sd_m;
    r[1] = body[body::hip_y] / sd_m;
    return true;
  }
};

/// A joint's limits at one phase: r = max(0, min − q, q − max) / sd, zero inside.
struct JointLimitResidual {
  using DependsOn = Blocks<1, Others<kSizeOf<&Runner::hip>>>;  // of any joint

  int harmonics;
  double phase;
  SagittalModel::Range range;
  double sd_rad;

  template <typename T>
  bool operator()(const T* curve, T* r) const {
    const T q = evaluate_series(curve, harmonics, T(phase));
    r[0] = T(0);
    if (q > range.max) r[0] = (q - range.max) / sd_rad;
    if (q < range.min) r[0] = (range.min - q) / sd_rad;
    return true;
  }
};

/// A foot that stands on level ground: the toe (or ankle) is as far below the pelvis as the pelvis
/// is above the ground, all through stance; where the camera's roll is wrong the foot climbs.
///   r = (q_y(φ) + h(φ) − g) / sd
/// with the height h of the pelvis as the image shows it, but for a constant, and the unknown g.
struct StanceResidual {
  using DependsOn = Blocks<1, Others<1>, &Runner::body, &Runner::sides, &Runner::tilt, &Runner::hip,
                           &Runner::knee, &Runner::ankle, &Runner::asymmetry>;

  BodyPart part;
  Directions directions;
  int harmonics;
  double phase, vertical_oscillation_m, sd_m;

  template <typename T>
  bool operator()(const T* body, const T* sides, const T* tilt, const T* hip, const T* knee,
                  const T* ankle, const T* asymmetry, const T* ground_m, T* r) const {
    const T at(phase);
    const auto leg =
        leg_angles(hip, knee, ankle, asymmetry, harmonics, side_of(part) < 0 ? -1 : 1, at);
    const Vector2<T> q = place_part(part, directions, body, sides,
                                    evaluate_series(tilt, kTiltHarmonics, at), leg, at);
    r[0] = (q.y() + vertical_oscillation_m - ground_m[0]) / sd_m;
    return true;
  }
};

}  // namespace stride::fit
