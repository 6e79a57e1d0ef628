#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "calibrate/runner/sagittal_model.h"
#include "extract/skeleton/body_part.h"
#include "extract/skeleton/fourier_series.h"

namespace stride {

inline constexpr int kMaxHarmonics = 6, kTiltHarmonics = 2, kAsymmetryHarmonics = 1;

// The entries of the runner's blocks of parameters. A new one is added here, before `size`.
namespace camera {
enum { log_px_per_m, drift_per_s, roll, size };  // roll: of the ground in the image, ccw, rad
}
namespace cadence {
enum { period_s, drift_hz_s, size };  // phase φ(u) = u / period + drift u² / 2, u from the middle
}
namespace body {  // m; hip: from the marked pelvis to the midpoint of the hips; lumbar in rad
enum { thigh, shank, foot, trunk, hip_x, hip_y, lumbar, size };
}
namespace heel {  // of the foot's frame, from the ankle, m; a block beside the runner's
enum { forward, up, size };
}
namespace sides {  // half of right − left. depth: the nearer leg looks larger; hips: m
enum { depth, hip_x, hip_y, swing_cos, swing_sin, drop_cos, drop_sin, size };
}
namespace asymmetry {  // right − left of each angle, a series of one harmonic; where each begins
enum { hip = 0, knee = 2 * kAsymmetryHarmonics + 1, ankle = 2 * knee, size = 3 * knee };
}

/// A runner as the fit sees one: limbs of the runner's own lengths that hang from the midpoint of
/// the hips, periodic angles, and the camera. Axes of the ground: x the way of running, y up. Each
/// member is one block of parameters.
struct Runner {
  std::array<double, camera::size> camera{};
  std::array<double, cadence::size> cadence{};
  std::array<double, body::size> body{};
  std::array<double, sides::size> sides{};
  FourierSeries<kTiltHarmonics> tilt{};
  FourierSeries<kMaxHarmonics> hip{}, knee{}, ankle{};  // of the right leg, rad
  std::array<double, asymmetry::size> asymmetry{};
};

/// Visits the blocks in the order of the solver, of `flattened` and of the covariance.
template <typename AnyRunner, typename Visit>
constexpr void for_each_block(AnyRunner& runner, Visit visit) {
  visit(runner.camera), visit(runner.cadence), visit(runner.body), visit(runner.sides);
  visit(runner.tilt), visit(runner.hip), visit(runner.knee), visit(runner.ankle);
  visit(runner.asymmetry);
}

/// How many parameters a runner has.
inline constexpr std::size_t kRunnerParameters = [] {
  std::size_t count = 0;
  const Runner runner;
  for_each_block(runner, [&](const auto& block) { count += block.size(); });
  return count;
}();
static_assert(kRunnerParameters * sizeof(double) == sizeof(Runner), "for_each_block forgets one");

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
  return {evaluate_series(hip, harmonics, own) +
              half * evaluate_series(asymmetry + asymmetry::hip, kAsymmetryHarmonics, own),
          evaluate_series(knee, harmonics, own) +
              half * evaluate_series(asymmetry + asymmetry::knee, kAsymmetryHarmonics, own),
          evaluate_series(ankle, harmonics, own) +
              half * evaluate_series(asymmetry + asymmetry::ankle, kAsymmetryHarmonics, own)};
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
/// Of a heel that of its ankle.
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
  const int below = joints_below_hip(part);
  if (below > 0) {
    const T thigh_angle = tilt + leg.hip, shank_angle = thigh_angle + leg.knee;
    p += turned(thigh_angle, Vector2<T>(T(0), -body[body::thigh]));
    if (below > 1) {
      p += turned(shank_angle, Vector2<T>(T(0), -body[body::shank]));
      if (below > 2) p += body[body::foot] * turned(T(shank_angle + leg.ankle), directions.foot);
    }
  }
  return magnification * p;
}

/// The same of a heel whose place on the foot is known.
template <typename T>
Vector2<T> place_part(BodyPart part, const Directions& directions, const T* body, const T* sides,
                      const T& tilt, const LegAngles<T>& leg, const T& phase, const T* heel) {
  const T foot_angle = tilt + leg.hip + leg.knee + leg.ankle,
          magnification = 1.0 + double(side_of(part)) * sides[sides::depth];
  return place_part(part, directions, body, sides, tilt, leg, phase) +
         magnification * turned(foot_angle, Vector2<T>(heel[heel::forward], heel[heel::up]));
}

}  // namespace stride
