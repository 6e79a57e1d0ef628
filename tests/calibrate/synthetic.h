#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <random>

#include "calibrate/fit/fit.h"
#include "extract/skeleton/trajectory.h"
#include "extract/skeleton/units.h"

namespace stride {

inline SagittalModel default_sagittal_model() {
  return sagittal_model(osim::load_osim(osim::default_model_file()));
}

/// A runner with known parameters: the angles of Hamner, Seth and Delp (2010, subject02, three
/// harmonics) on limbs that are not the model's.
inline Runner synthetic_runner() {
  const auto series = [&](std::initializer_list<double> degrees) {
    FourierSeries<kMaxHarmonics> all{};
    std::size_t i = 0;
    for (const double each : degrees) all[i++] = each * kDegree;
    return all;
  };
  Runner r;
  r.camera = {std::log(130.0), 0.004, 0.0};
  r.cadence = {0.69, 0.005};
  r.body = {0.43, 0.42, 0.21, 0.74, 0.004, -0.003, 0};
  r.sides = {0.006, 0, 0, 0.008, -0.002, 0.001, 0.003};
  r.tilt[0] = -4 * kDegree;
  r.hip = series({11.77, 30.45, -14.41, -8.19, 2.99, -3.12, 1.68});
  r.knee = series({-51.32, 7.69, 27.96, 17.57, -20.96, 5.36, -1.27});
  r.ankle = series({-0.66, 16.96, 6.25, -10.89, 3.10, -2.15, -2.69});
  r.asymmetry = {0.4 * kDegree, 0.3 * kDegree, 0, -0.5 * kDegree, 0, 0.6 * kDegree, 0, 0, 0};
  return r;
}

/// Options of the synthetic clip.
struct SyntheticClip {
  double rate_hz = 30, duration_s = 3;
  bool to_left = false, toes = true, heels = false;
  double noise_px = 0;
  double outliers = 0;  // share of the points that are displaced by 30 to 120 px
  unsigned seed = 1;
};

inline Trajectory synthetic_trajectory(const Runner& runner, const SagittalModel& model,
                                       const SyntheticClip& clip) {
  std::mt19937_64 random(clip.seed);
  std::normal_distribution<double> noise(0, clip.noise_px > 0 ? clip.noise_px : 1);
  std::uniform_real_distribution<double> uniform(0, 1);
  fit::StrideFit truth;
  truth.runner = runner;
  truth.harmonics = kMaxHarmonics;
  truth.heel = {-0.07, -0.06};
  truth.pelvis_px.resize(1);
  Trajectory trajectory;
  trajectory.video = "synthetic";
  trajectory.width_px = 640;
  trajectory.height_px = 360;
  trajectory.rate_hz = clip.rate_hz;
  trajectory.direction = clip.to_left ? Facing::left : Facing::right;
  const int frames = static_cast<int>(clip.duration_s * clip.rate_hz) + 1;
  const double middle_s = 0.5 * (frames - 1) / clip.rate_hz;
  for (int i = 0; i < frames; ++i) {
    TrajectoryFrame& frame = trajectory.frames.emplace_back();
    frame.frame = i;
    frame.time_s = i / clip.rate_hz;
    const double u = frame.time_s - middle_s;
    // The camera follows with a slow sway; the pelvis rises and falls twice a stride.
    const double phase = phase_at(runner.cadence.data(), u);
    truth.pelvis_px[0] = {
        12 * std::sin(1.1 * u),
        10 + 3 * std::cos(0.9 * u) + 5 * std::cos(4 * std::numbers::pi * phase + 0.9)};
    for (const BodyPart part : kBodyParts) {
      const bool toe = part == BodyPart::toe_r || part == BodyPart::toe_l;
      if (part == BodyPart::head || (toe && !clip.toes) || (is_heel(part) && !clip.heels)) continue;
      Eigen::Vector2d p = fit::predicted_px(truth, Directions(model), part, 0, u);
      if (clip.noise_px > 0) p += Eigen::Vector2d(noise(random), noise(random));
      if (uniform(random) < clip.outliers) {
        const double angle = 2 * std::numbers::pi * uniform(random);
        p += (30 + 90 * uniform(random)) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      }
      frame[part] = {{320 + (clip.to_left ? -p.x() : p.x()), 180 - p.y()}, Source::clicked, 1};
    }
  }
  return trajectory;
}

}  // namespace stride
