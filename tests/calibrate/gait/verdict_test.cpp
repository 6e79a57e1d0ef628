#include "calibrate/gait/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibrate.h"
#include "tests/calibrate/synthetic.h"

namespace stride {
namespace {

using testing::HasSubstr;

class Verdicts : public testing::Test {
 protected:
  const SagittalModel model_ = sagittal_model(osim::load_osim(osim::default_model_file()));

  Trajectory good() const {
    return synthetic_trajectory(synthetic_runner(), model_, {.duration_s = 2, .noise_px = 1});
  }
  std::string judge(const Trajectory& trajectory) const {
    return calibrate(trajectory, model_).verdict.text();
  }
};

TEST_F(Verdicts, ARunIsOk) { EXPECT_EQ(judge(good()), "ok"); }

/// Of 200 px on a runner of 130 px a metre.
CalibrationLine line_of(double length_m) { return {20, {100, 50}, {100, 250}, length_m}; }

TEST_F(Verdicts, ACalibrationLineSetsTheScale) {
  Trajectory t = good();
  t.calibration_line = line_of(200 / 120.0);  // the leg is 0.92 m
  const Calibration by_line = calibrate(t, model_);
  EXPECT_TRUE(by_line.scaled_by_line);
  EXPECT_EQ(by_line.verdict.text(), "ok");
  EXPECT_NEAR(120 * by_line.run.metres_per_pixel, 1, 0.01);
  EXPECT_NEAR(by_line.fit.scale_relative_sd(), t.calibration_line->relative_sd(), 0.003);
  const Calibration by_leg = calibrate(good(), model_);
  EXPECT_FALSE(by_leg.scaled_by_line);
  EXPECT_NEAR(130 * by_leg.run.metres_per_pixel, 1, 0.01);
  EXPECT_NEAR(by_line.run.speed_m_s / by_leg.run.speed_m_s, 130 / 120.0, 0.01);
}

TEST_F(Verdicts, ACalibrationLineIsACheckWhereTheSizeIsGiven) {
  Trajectory t = good();
  t.calibration_line = line_of(1.99);  // the leg is 1.10 m
  fit::FitOptions options;
  options.leg_m = {0.85, 0.005};
  options.size_given = true;
  const Calibration by_leg = calibrate(t, model_, options);
  EXPECT_FALSE(by_leg.scaled_by_line);
  EXPECT_NEAR(130 * by_leg.run.metres_per_pixel, 1, 0.01);
  EXPECT_THAT(by_leg.verdict.text(), HasSubstr("the leg is 1.10 m, the given one 0.85 m"));
  EXPECT_FALSE(by_leg.verdict.refused);
}

TEST_F(Verdicts, ACalibrationLineThatNoRunnerFitsIsTold) {
  Trajectory t = good();
  t.calibration_line = line_of(2);
  EXPECT_THAT(judge(t), HasSubstr("ok, but by the calibration line"));
  t.calibration_line = line_of(8);  // the leg is 4.4 m
  EXPECT_THAT(judge(t), testing::StartsWith("refused: by the calibration line"));
}

TEST_F(Verdicts, OneLegOnlyIsRefused) {
  Trajectory t = good();
  for (TrajectoryFrame& frame : t.frames) frame[BodyPart::knee_l] = {};
  EXPECT_THAT(judge(t), HasSubstr("refused: knee_l is marked in 0 of 61 frames"));
}

TEST_F(Verdicts, AClipOnItsHeadIsRefused) {
  Trajectory t = good();
  for (TrajectoryFrame& frame : t.frames)
    for (Point& point : frame.points) point.p_px.y() = 360 - point.p_px.y();
  EXPECT_THAT(judge(t), HasSubstr("refused: knees are above the pelvis"));
}

TEST_F(Verdicts, SomebodyWhoStandsIsRefused) {
  Trajectory t = good();
  for (TrajectoryFrame& frame : t.frames) frame.points = t.frames[0].points;
  EXPECT_THAT(judge(t), HasSubstr("nobody runs here"));
}

TEST_F(Verdicts, ARunTowardsTheCameraIsRefused) {
  Trajectory t = good();
  for (TrajectoryFrame& frame : t.frames) {
    const double pelvis = frame[BodyPart::pelvis].p_px.x();
    for (Point& point : frame.points) point.p_px.x() = pelvis + 0.15 * (point.p_px.x() - pelvis);
  }
  EXPECT_THAT(judge(t), HasSubstr("not seen from the side"));
}

TEST_F(Verdicts, LessThanAStrideIsRefused) {
  const Trajectory t =
      synthetic_trajectory(synthetic_runner(), model_, {.duration_s = 0.5, .noise_px = 0.5});
  EXPECT_THAT(judge(t), HasSubstr("refused: "));
}

TEST_F(Verdicts, MarksAtRandomAreRefused) {
  Trajectory t = good();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> anywhere(0, 360);
  for (TrajectoryFrame& frame : t.frames)
    for (Point& point : frame.points)
      if (point.present()) point.p_px = {anywhere(random), anywhere(random)};
  EXPECT_THAT(judge(t), HasSubstr("refused: "));
}

TEST_F(Verdicts, TheWrongDirectionIsRefusedAndAnUnknownOneFound) {
  Trajectory t = good();
  t.direction = Facing::left;
  EXPECT_THAT(judge(t), HasSubstr("refused: the knees bend forward"));
  t.direction = std::nullopt;
  EXPECT_EQ(judge(t), "ok");
}

TEST_F(Verdicts, WalkingIsTold) {
  const Trajectory walk =
      load_trajectory(std::filesystem::path(STRIDE_SOURCE_DIR) / "videos/walk.truth.csv");
  EXPECT_EQ(judge(walk), "ok, but this is walking: a foot stands for 66 % of the stride");
}

TEST_F(Verdicts, AWrongFrameRateIsTold) {
  Trajectory t = good();
  for (TrajectoryFrame& frame : t.frames) frame.time_s *= 2;
  EXPECT_THAT(judge(t), HasSubstr("is the frame rate right, or is it slow motion"));
}

TEST_F(Verdicts, TwoPeopleWhoCrossAreTold) {
  Trajectory t = good();
  // For a third of the clip the points are on somebody who runs in the other direction.
  const Trajectory other = synthetic_trajectory(
      synthetic_runner(), model_, {.duration_s = 2, .to_left = true, .noise_px = 1, .seed = 2});
  for (TrajectoryFrame& frame : t.frames)
    if (frame.frame >= 20 && frame.frame < 40) {
      frame.points = other.frames[static_cast<std::size_t>(frame.frame)].points;
      for (Point& point : frame.points) point.p_px.x() += 6.0 * (30 - frame.frame);
    }
  EXPECT_THAT(judge(t), HasSubstr("another person"));
}

TEST_F(Verdicts, BlackFramesAreTold) {
  Trajectory lost = good(), guessed = good();
  for (int i = 20; i < 40; ++i) {
    lost.frames[i].points = {};
    for (Point& point : guessed.frames[i].points) point.confidence *= 0.2;  // the prior alone
  }
  for (const Trajectory& t : {lost, guessed})
    EXPECT_THAT(judge(t), HasSubstr("nothing is seen between frames 19 and 40"));
}

TEST_F(Verdicts, ACutIsTold) {
  Trajectory t = good();
  for (TrajectoryFrame& frame : t.frames)
    if (frame.frame >= 40)
      for (Point& point : frame.points) point.p_px.x() += 150;
  EXPECT_THAT(judge(t), HasSubstr("at frame 40: a cut, or another person"));
}

}  // namespace
}  // namespace stride
