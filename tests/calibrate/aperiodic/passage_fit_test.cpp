// The fit of a jump against the truth of the rendered ones, from points with a person's noise.
#include <gtest/gtest.h>

#include <cmath>

#include "calibrate/calibrate.h"
#include "extract/annotation/labelled_clip.h"
#include "extract/io/random.h"
#include "tests/support/throws.h"
#include "videos/truth.h"

namespace stride {
namespace {

using videos::Clip;

const SagittalModel& model() {
  static const SagittalModel model = sagittal_model(osim::load_osim(osim::default_model_file()));
  return model;
}

/// Every part in every frame, but the hips, with noise; the camera's motion as a wall behind the
/// jumper shows it.
Trajectory observed(const Clip& clip, double noise_px, unsigned seed = 1) {
  Trajectory points = videos::truth_px(clip);
  const videos::Motion motion(clip);
  Random random(seed);
  for (std::size_t i = 0; i < points.frames.size(); ++i) {
    TrajectoryFrame& frame = points.frames[i];
    for (const BodyPart part : kAskedParts)
      frame[part].p_px += Eigen::Vector2d(noise_px * normal(random), noise_px * normal(random));
    frame[BodyPart::hip_r] = frame[BodyPart::hip_l] = {};
    if (i == 0) continue;
    constexpr double kWall_m = 3.5;
    const double behind_m = clip.to_left ? kWall_m : -kWall_m;
    const auto now = motion.camera(frame.time_s),
               before = motion.camera(points.frames[i - 1].time_s);
    const Eigen::Vector3d mark(now.x_m, now.height_m, behind_m);
    frame.camera_px = now.project(mark) - before.project(mark);
    frame.camera_residual_px = 0.1;
  }
  return points;
}

/// Rms distance of knees and ankles from where the true angles put them on the model, m.
double rms_m(const CalibratedTrajectory& run, const Clip& clip) {
  double sum = 0;
  int n = 0;
  for (const CalibratedSample& sample : run.samples) {
    const videos::Skeleton s = videos::Motion(clip).skeleton(sample.time_s);
    CalibratedSample truth;
    truth.coordinates = {s.pelvis_tilt,
                         0,
                         0,
                         s.hip_flexion[0],
                         s.knee_angle[0],
                         s.ankle_angle[0],
                         s.hip_flexion[1],
                         s.knee_angle[1],
                         s.ankle_angle[1]};
    place_parts(model(), truth);
    for (const BodyPart part :
         {BodyPart::knee_r, BodyPart::knee_l, BodyPart::ankle_r, BodyPart::ankle_l}) {
      sum += (sample[part] - truth[part]).squaredNorm();
      ++n;
    }
  }
  return std::sqrt(sum / n);
}

class Jumps : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(EachClip, Jumps, testing::Values("jump", "jump_left"));

void expect_within_bounds(const Clip& clip, const Trajectory& points) {
  const Calibration found = calibrate(points, model());
  ASSERT_FALSE(found.verdict.refused) << found.verdict.text();
  EXPECT_EQ(found.run.movement, "jump");
  const double rms = rms_m(found.run, clip);
  EXPECT_LT(rms, 0.025);
  const double true_m_px = videos::Motion(clip).camera(clip.duration_s() / 2).metres_per_pixel();
  const double scale = found.run.metres_per_pixel / true_m_px,
               by_fall = 1 / found.aperiodic->flight.px_per_m / true_m_px;
  EXPECT_NEAR(scale, 1, 0.03);
  EXPECT_NEAR(by_fall, 1, 0.05) << "by free fall alone";
  const double take_off_s = clip.stands_first_s + clip.jump->take_off_s(),
               landing_s = clip.stands_first_s + clip.jump->landing_s();
  const auto record = [](const char* key, double value) {  // --gtest_output=xml:FILE
    testing::Test::RecordProperty(key, fmt::format("{:.4f}", value));
  };
  record("rms_m", rms);
  record("scale", scale);
  record("scale_by_fall", by_fall);
  record("take_off_s", found.run.take_off_s - take_off_s);
  record("landing_s", found.run.landing_s - landing_s);
  const double true_displacement_m = clip.jump->length_m() *
                                     (model().thigh_m() + model().shank_m()) /
                                     (clip.proportions.thigh + clip.proportions.shank);
  EXPECT_NEAR(found.run.samples.back().coordinates[1], true_displacement_m, 0.06);
  EXPECT_NEAR(found.run.take_off_s, take_off_s, 1 / clip.rate_hz);
  EXPECT_NEAR(found.run.landing_s, landing_s, 1 / clip.rate_hz);
}

TEST_P(Jumps, AreFittedWithinTheirBounds) {
  const Clip clip = videos::clip(GetParam());
  expect_within_bounds(clip, observed(clip, 1.0));
}

// From the clicks and the picture, as `stride convert` does it.
TEST_P(Jumps, AreTrackedAndFittedWithinTheirBounds) {
  const std::filesystem::path video =
      std::filesystem::path(STRIDE_SOURCE_DIR) / "videos" / (std::string(GetParam()) + ".mp4");
  const Trajectory points =
      tracking::track(video, tracking::clicks_on(video, keypoints_file_of(video), 0)).trajectory;
  expect_within_bounds(videos::clip(GetParam()), points);
}

TEST(Jump, OnTheModelFallsWithGravityInFlight) {
  const Clip clip = videos::clip("jump");
  const CalibratedTrajectory run = calibrate(observed(clip, 0.3), model()).run;
  // The pelvis about as the centre of mass.
  const auto at = [&](double time_s) {
    return run.samples[static_cast<std::size_t>(std::lround(100 * time_s))].coordinates[2];
  };
  const double middle_s = 0.5 * (run.take_off_s + run.landing_s), h = 0.12;
  EXPECT_NEAR((at(middle_s - h) - 2 * at(middle_s) + at(middle_s + h)) / (h * h), -9.81, 1.5);
}

TEST(Jump, ThatNeverLeavesTheGroundIsNone) {
  Clip clip = videos::clip("jump");
  clip.frames = 24;  // 0.8 s: the countermovement
  const Calibration found = calibrate(observed(clip, 0.5), model());
  EXPECT_TRUE(found.verdict.refused);
  EXPECT_THAT(found.verdict.text(), testing::HasSubstr("both feet never leave the ground"));
}

TEST(Jump, OfWhichHalfIsSeenIsRefused) {
  Clip clip = videos::clip("jump");
  clip.frames = 39;  // 1.3 s: before the landing
  const Calibration found = calibrate(observed(clip, 0.5), model());
  EXPECT_TRUE(found.verdict.refused);
  EXPECT_THAT(found.verdict.text(), testing::HasSubstr("the clip ends in the air: half a jump"));
}

TEST(Jump, OutOfThePictureIsRefused) {
  Clip clip = videos::clip("jump");
  clip.camera.x_m -= 1.6;  // it lands beyond the right edge
  const Calibration found = calibrate(observed(clip, 0.5), model());
  EXPECT_TRUE(found.verdict.refused);
  EXPECT_THAT(found.verdict.text(), testing::HasSubstr("the jumper leaves the picture: on"));
}

TEST(Jump, InSlowMotionIsToldByItsFall) {
  const Clip clip = videos::clip("jump");
  Trajectory slow = observed(clip, 0.5);
  for (TrajectoryFrame& frame : slow.frames) frame.time_s *= 2;
  const Calibration found = calibrate(slow, model());
  EXPECT_THAT(found.verdict.text(), testing::HasSubstr("--slow-motion 1.9"));
}

TEST(Jump, IsNoRunAndARunIsNoJump) {
  Trajectory run = observed(videos::clip("human"), 0.5);
  run.movement = "jump";
  const Calibration as_jump = calibrate(run, model());
  EXPECT_TRUE(as_jump.verdict.refused);
  EXPECT_THAT(as_jump.verdict.text(), testing::HasSubstr("a run is --movement run"));

  Trajectory jump = observed(videos::clip("jump"), 0.5);
  jump.movement = "run";
  const Calibration as_run = calibrate(jump, model());
  EXPECT_TRUE(as_run.verdict.refused);
  EXPECT_THAT(as_run.verdict.text(), testing::HasSubstr("A jump is --movement jump"));
}

}  // namespace
}  // namespace stride
