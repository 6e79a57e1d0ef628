#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "calibrate/runner/sagittal_model.h"
#include "extract/skeleton/body_part.h"

namespace stride {

/// A periodic curve: c[0] + Σ_h c[2h−1] cos 2πhφ + c[2h] sin 2πhφ.
template <std::size_t N>
using Series = std::array<double, N>;

inline constexpr int kMaxHarmonics = 6;

/// The parameters of the fit: lengths of the limbs, which hang from the midpoint of the hips,
/// periodic angles, and the camera. Axes of the ground: x in the running direction, y up. Each
/// member is a parameter block; the indices of its entries are below.
struct Runner {
  std::array<double, 3> camera{};
  std::array<double, 2> cadence{};
  std::array<double, 7> body{};
  std::array<double, 7> sides{};
  Series<5> tilt{};
  Series<2 * kMaxHarmonics + 1> hip{}, knee{}, ankle{};  // of the right leg, rad
  std::array<double, 9> asymmetry{};  // right − left of hip, knee, ankle: mean, cosine, sine
};

namespace camera {
enum { log_px_per_m, drift_per_s, roll };  // roll: of the ground in the image, ccw, rad
}
namespace cadence {
enum { period_s, drift_hz_s };  // phase φ(u) = u / period + drift u² / 2, u from the middle
}
namespace body {  // m; hip: from the marked pelvis to the midpoint of the hips; lumbar in rad
enum { thigh, shank, foot, trunk, hip_x, hip_y, lumbar };
}
namespace sides {  // half of right − left. depth: the nearer leg looks larger; hips: m
enum { depth, hip_x, hip_y, swing_cos, swing_sin, drop_cos, drop_sin };
}

/// Sign of a leg: +1 right, −1 left.
inline int side_of(BodyPart part) {
  switch (part) {
    case BodyPart::hip_r:
    case BodyPart::knee_r:
    case BodyPart::ankle_r:
    case BodyPart::toe_r:
      return 1;
    case BodyPart::hip_l:
    case BodyPart::knee_l:
    case BodyPart::ankle_l:
    case BodyPart::toe_l:
      return -1;
    default:
      return 0;
  }
}

/// Value of a series with its first `harmonics` harmonics at a phase.
template <typename T>
T evaluate_series(const T* c, int harmonics, const T& phase) {
  using std::cos;
  using std::sin;
  const T angle = 2 * std::numbers::pi * phase, c1 = cos(angle), s1 = sin(angle);
  T value = c[0], ch = c1, sh = s1;
  for (int h = 1; h <= harmonics; ++h) {
    value += c[2 * h - 1] * ch + c[2 * h] * sh;
    const T next = ch * c1 - sh * s1;  // cos (h + 1) α
    sh = sh * c1 + ch * s1;
    ch = next;
  }
  return value;
}

/// Phase at `u_s` from the middle of the clip.
template <typename T>
T phase_at(const T* cadence, double u_s) {
  return u_s / cadence[cadence::period_s] + 0.5 * cadence[cadence::drift_hz_s] * u_s * u_s;
}

/// Hip to ankle of the stretched leg, px.
inline double leg_px(const Runner& runner) {
  return (runner.body[body::thigh] + runner.body[body::shank]) *
         std::exp(runner.camera[camera::log_px_per_m]);
}

/// Angles of one leg at a phase of the right leg's cycle: the left leg is half a cycle later.
template <typename T>
struct LegAngles {
  T hip, knee, ankle;
};

template <typename T>
LegAngles<T> leg_angles(const T* hip, const T* knee, const T* ankle, const T* asymmetry,
                        int harmonics, int side, const T& phase) {
  const T own = side > 0 ? phase : phase + 0.5;
  const double half = 0.5 * side;
  return {evaluate_series(hip, harmonics, own) + half * evaluate_series(asymmetry, 1, own),
          evaluate_series(knee, harmonics, own) + half * evaluate_series(asymmetry + 3, 1, own),
          evaluate_series(ankle, harmonics, own) + half * evaluate_series(asymmetry + 6, 1, own)};
}

/// Directions of the model's foot and trunk, as unit vectors.
struct Directions {
  Eigen::Vector2d foot;   // talus to toes at foot angle 0
  Eigen::Vector2d trunk;  // hips to head at tilt 0
  explicit Directions(const SagittalModel& model)
      : foot(model.p_talus_toes_m.normalized()),
        trunk((model.p_pelvis_head_m - model.p_pelvis_hip_m).normalized()) {}
};

/// Position of a part relative to the labelled pelvis, m: limbs of fixed length, knees as hinges.
template <typename T>
Vector2<T> place_part(BodyPart part, const Directions& directions, const T* body, const T* sides,
                      const T& tilt, const LegAngles<T>& leg, const T& phase) {
  using std::cos;
  using std::sin;
  const Vector2<T> hips(body[body::hip_x], body[body::hip_y]);
  if (part == BodyPart::pelvis) return Vector2<T>(T(0), T(0));
  if (part == BodyPart::head)
    return hips + body[body::trunk] * turned(T(tilt + body[body::lumbar]), directions.trunk);
  const T turn = 2 * std::numbers::pi * phase, c = cos(turn), s = sin(turn);
  const double side = side_of(part);
  const Vector2<T> swing(
      sides[sides::hip_x] + sides[sides::swing_cos] * c + sides[sides::swing_sin] * s,
      sides[sides::hip_y] + sides[sides::drop_cos] * c + sides[sides::drop_sin] * s);
  const T magnification = 1.0 + side * sides[sides::depth];
  Vector2<T> p = hips + side * swing;
  if (part != BodyPart::hip_r && part != BodyPart::hip_l) {
    const T thigh_angle = tilt + leg.hip, shank_angle = thigh_angle + leg.knee;
    p += turned(thigh_angle, Vector2<T>(T(0), -body[body::thigh]));
    if (part != BodyPart::knee_r && part != BodyPart::knee_l) {
      p += turned(shank_angle, Vector2<T>(T(0), -body[body::shank]));
      if (part == BodyPart::toe_r || part == BodyPart::toe_l)
        p += body[body::foot] * turned(T(shank_angle + leg.ankle), directions.foot);
    }
  }
  return magnification * p;
}

}  // namespace stride
