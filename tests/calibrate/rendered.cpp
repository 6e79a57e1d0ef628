#include "tests/calibrate/rendered.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "extract/io/random.h"
#include "extract/tracking/track.h"
#include "videos/truth.h"

namespace stride {
namespace {

using videos::Clip;
using videos::Motion;

/// The true angles on the model.
CalibratedSample true_sample(const Motion& motion, const SagittalModel& model, double time_s) {
  const videos::Skeleton s = motion.skeleton(time_s);
  CalibratedSample sample;
  sample.coordinates = {s.pelvis_tilt,
                        0,
                        0,
                        s.hip_flexion[0],
                        s.knee_angle[0],
                        s.ankle_angle[0],
                        s.hip_flexion[1],
                        s.knee_angle[1],
                        s.ankle_angle[1]};
  place_parts(model, sample);
  return sample;
}

/// Height of the model's pelvis origin: its legs on the ground with the true angles, its rise and
/// fall the runner's on legs of the model.
class TrueHeight {
 public:
  TrueHeight(const Clip& clip, const SagittalModel& model)
      : gait_(clip.gait),
        to_model_((model.thigh_m() + model.shank_m()) /
                  (clip.proportions.thigh + clip.proportions.shank)) {
    constexpr int kPhases = 200;
    for (int i = 0; i < kPhases; ++i) {
      const double phase = static_cast<double>(i) / kPhases;
      const videos::Skeleton s = videos::pose(clip.gait, clip.proportions, phase, 0, 0);
      const auto leg =
          place_leg(model, s.pelvis_tilt, s.hip_flexion[0], s.knee_angle[0], s.ankle_angle[0]);
      lowest_m_ = std::min(lowest_m_, lowest_point(model, leg) + vertical_oscillation(phase));
    }
  }
  double at(double phase) const { return vertical_oscillation(phase) - lowest_m_; }

 private:
  double vertical_oscillation(double phase) const {
    return to_model_ * (gait_.pelvis_height_m(phase) - gait_.pelvis_height_m.mean);
  }
  const videos::GaitCurves& gait_;
  double to_model_ = 1, lowest_m_ = 0;
};

}  // namespace

Trajectory observed(const Clip& clip, const Marking& how) {
  constexpr double kWall_m = -3.5;  // the background that passes
  const Motion motion(clip);
  const Trajectory truth = videos::truth_px(clip);
  Random random(how.seed * 7919 + 17);
  const auto noise = [&](double sd) {
    const double x = sd * normal(random), y = sd * normal(random);
    return Eigen::Vector2d(x, y);
  };
  Clip labelled = clip;
  labelled.click_seed = how.seed;
  const Keypoints clicked = videos::clicks(labelled);
  Trajectory seen = truth;
  for (TrajectoryFrame& frame : seen.frames) {
    for (const BodyPart part : kAskedParts) {
      const bool wanted =
          part != BodyPart::head && part != BodyPart::hip_r && part != BodyPart::hip_l;
      const bool here = how.every_frame || clicked.frames.contains(frame.frame);
      if (wanted && here)
        frame[part].p_px += noise(how.noise_px);
      else
        frame[part] = {};
    }
    if (frame.frame == 0 || !clip.camera_follows) continue;
    const auto before = motion.camera(clip.time_s(frame.frame - 1)),
               now = motion.camera(frame.time_s);
    const Eigen::Vector3d mark(now.x_m, now.height_m, kWall_m);
    frame.camera_px = now.project(mark) - before.project(mark) + noise(0.1);
  }
  return seen;
}

Clip varied(Clip clip, unsigned seed) {
  Random random(seed * 104729 + 3);
  const auto between = [&](double low, double high) {
    return low + (high - low) * uniform(random);
  };
  videos::Proportions& p = clip.proportions;
  const double size = between(0.95, 1.05);
  p.thigh *= size * between(0.96, 1.04);
  p.shank *= size * between(0.96, 1.04);
  p.toe_forward *= between(0.9, 1.1);
  clip.first_phase = uniform(random);
  clip.camera.distance_m *= between(0.8, 1.4);
  clip.camera.focal_px *= between(0.9, 1.3);
  clip.camera.roll_rad = between(-0.03, 0.03);
  clip.gait.period_s *= between(0.93, 1.07);
  clip.seed = 1000 + seed;
  return clip;
}

Clip turned_camera(Clip clip, unsigned seed) {
  constexpr double kTilt = 0.17, kZoom = 0.3;  // of the picture's height; of the focal length
  Random random(seed * 15485863 + 11);
  const double tilt = uniform(random), zoom = uniform(random);
  if (seed % 3 != 1) clip.tilt_px = (2 * tilt - 1) * kTilt * clip.height_px;
  if (seed % 3 != 0) clip.zoom = (2 * zoom - 1) * kZoom;
  return clip;
}

fit::Prior known_leg(const Clip& clip, unsigned seed) {
  constexpr double kSd = 0.02;
  Random random(seed * 7 + 1);
  const double leg_m = clip.proportions.thigh + clip.proportions.shank;
  return {leg_m * std::exp(kSd * normal(random)), kSd};
}

double Accuracy::worst_rms_m() const { return *std::ranges::max_element(rms_m); }

Accuracy accuracy(const Calibration& found, const Clip& clip, const SagittalModel& model) {
  const Motion motion(clip);
  const CalibratedTrajectory& run = found.run;
  Accuracy a;
  const double metres = motion.camera(clip.duration_s() / 2).metres_per_pixel();
  a.period = run.period_s / clip.gait.period_s - 1;
  a.scale = run.metres_per_pixel / metres - 1;
  a.speed = run.speed_m_s / motion.speed_m_s() - 1;
  a.roll_rad = run.camera_roll_rad - clip.camera.roll_rad;
  a.period_z = (run.period_s - clip.gait.period_s) / run.period_sd_s;
  a.scale_z = std::log(run.metres_per_pixel / metres) / found.fit.scale_relative_sd();
  const TrueHeight height(clip, model);
  const auto count = [&](double off, double sd) {
    a.inside += std::abs(off) < 1.96 * sd ? 1 : 0;
    ++a.coordinates;
  };
  const auto n = static_cast<double>(run.samples.size());
  for (const CalibratedSample& sample : run.samples) {
    const CalibratedSample truth = true_sample(motion, model, sample.time_s);
    const double phase = clip.first_phase + sample.time_s / clip.gait.period_s;
    count(sample.coordinates[2] - height.at(phase), sample.pelvis_height_sd_m);
    for (const int side : {0, 1}) {
      const BodyPart toe = side == 0 ? BodyPart::toe_r : BodyPart::toe_l;
      const auto foot = [&](const CalibratedSample& s) {
        const auto& q = s.coordinates;
        const auto hip = static_cast<std::size_t>(3 + 3 * side);
        return q[0] + q[hip] + q[hip + 1] + q[hip + 2];
      };
      a.toes_rms_m[side] += (sample[toe] - truth[toe]).squaredNorm() / n;
      a.feet_rms_rad[side] += std::pow(foot(sample) - foot(truth), 2) / n;
    }
    for (std::size_t i = 0; i < a.kParts.size(); ++i) {
      const Eigen::Vector2d off = sample[a.kParts[i]] - truth[a.kParts[i]];
      a.rms_m[i] += off.squaredNorm() / n;
      for (const int axis : {0, 1}) count(off[axis], sample.sd_m[index(a.kParts[i])][axis]);
    }
  }
  for (double& each : a.rms_m) each = std::sqrt(each);
  for (double& each : a.toes_rms_m) each = std::sqrt(each);
  for (double& each : a.feet_rms_rad) each = std::sqrt(each);
  return a;
}

}  // namespace stride
