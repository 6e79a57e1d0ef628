#include "extract/tracking/measurements.h"

#include <gtest/gtest.h>

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr BodyPart kKnee = BodyPart::knee_r;

Trajectory knee_marks(int frames, Source source, double confidence) {
  Trajectory marks;
  for (int f = 0; f < frames; ++f) {
    TrajectoryFrame& frame = marks.frames.emplace_back();
    frame.frame = f;
    frame.time_s = f / 30.0;
    frame[kKnee] = {{10.0 * f, 5}, source, confidence};
  }
  return marks;
}

gaussian_process::GaitPrior prior(double noise_px) {
  gaussian_process::GaitPrior prior;
  prior.legs.noise_px = noise_px;
  prior.trunk.noise_px = 9 * noise_px;
  return prior;
}

TEST(Measurements, ClicksAreTrustedAndDetectionsMayBeOutliers) {
  EXPECT_FALSE(measurements_of(knee_marks(1, Source::clicked, 1))[0].doubtful);
  EXPECT_TRUE(measurements_of(knee_marks(1, Source::detected, 1))[0].doubtful);
  EXPECT_TRUE(measurements_of(knee_marks(1, Source::hidden, kHiddenConfidence))[0].doubtful);
}

TEST(Measurements, HaveTheNoiseOfTheirLimbsGreaterWhereTheyAreLessCertain) {
  for (const auto& [confidence, sd_px] : {std::pair(1.0, 2.0), std::pair(0.5, 4.0)}) {
    Trajectory marks = knee_marks(1, Source::detected, confidence);
    marks.frames[0][BodyPart::pelvis] = marks.frames[0][kKnee];
    std::vector<Measurement> measurements = measurements_of(marks);
    weigh_marks(measurements, marks, prior(2));
    ASSERT_EQ(measurements.size(), 2U);  // the pelvis first, of the trunk
    EXPECT_DOUBLE_EQ(measurements[0].variance_px2.x(), 81 * sd_px * sd_px);
    EXPECT_DOUBLE_EQ(measurements[1].variance_px2.x(), sd_px * sd_px);
  }
}

TEST(Measurements, APredictionCountsTheLessTheWorseItFitsTheMarks) {
  const Trajectory marks = knee_marks(9, Source::clicked, 1);
  const auto variance_px2 = [&](double miss_px) {
    Trajectory prediction = marks;
    for (TrajectoryFrame& frame : prediction.frames) frame[kKnee].p_px.y() += miss_px;
    std::vector<Measurement> measurements;
    add_prediction(measurements, prediction, marks, prior(1));
    EXPECT_EQ(measurements.size(), 9U);
    return measurements.front().variance_px2.y();
  };
  EXPECT_LT(variance_px2(0), variance_px2(2));
  EXPECT_LT(variance_px2(2), variance_px2(4));
}

TEST(Measurements, APredictionWithFewCommonFramesIsLeftOut) {
  const Trajectory marks = knee_marks(2, Source::clicked, 1);
  std::vector<Measurement> measurements;
  add_prediction(measurements, marks, marks, prior(1));
  EXPECT_TRUE(measurements.empty());
}

TEST(Measurements, ThatDisagreeLoseWeightAndClicksDoNot) {
  const Trajectory marks = knee_marks(2, Source::detected, 1);
  std::vector<Measurement> measurements = measurements_of(marks);
  measurements.push_back(measurements_of(knee_marks(1, Source::clicked, 1))[0]);
  gaussian_process::Estimates estimates(2);
  estimates[0][index(kKnee)].p_px = Vector2d(0, 5);
  estimates[1][index(kKnee)].p_px = Vector2d(10, 5 + 12);  // twelve standard deviations away
  measurements[2].p_px = Vector2d(500, 500);
  reweigh(measurements, estimates, 0);
  EXPECT_DOUBLE_EQ(measurements[0].weight, 4.0 / 3);  // Student's t, three degrees of freedom
  EXPECT_DOUBLE_EQ(measurements[1].weight, 4.0 / (3 + 72));  // 12² / 2 in the mean over x and y
  EXPECT_EQ(measurements[2].weight, 1);
}

TEST(Measurements, AFlowSeenFromBothEndsIsTheMeanOfThem) {
  FlowStretch stretch{
      .part = kKnee,
      .first = 3,
      .last = 4,
      .forward = {{.displacement_px = {2, 0}, .inlier = true, .round_trip_px = 0.2}},
      .backward = {{.displacement_px = {4, 0}, .inlier = true, .round_trip_px = 0.4}}};
  std::vector<Measurement> both, one, none;
  add_flow(both, {stretch}, prior(1));
  stretch.backward[0].inlier = false;
  add_flow(one, {stretch}, prior(1));
  stretch.forward[0].inlier = false;
  add_flow(none, {stretch}, prior(1));
  ASSERT_EQ(both.size(), 1U);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(both[0].since_frame, 3);
  EXPECT_EQ(both[0].frame, 4);
  EXPECT_EQ(both[0].p_px, Vector2d(3, 0));
  EXPECT_EQ(one[0].p_px, Vector2d(2, 0));
  EXPECT_GT(both[0].variance_px2.x(), both[0].variance_px2.y());  // they differ along x
  EXPECT_GT(one[0].variance_px2.y(), both[0].variance_px2.y());
}

TEST(Measurements, TheMissOfTheFlowIsItsMeanSquareAtTheNextMark) {
  FlowStretch stretch{.part = kKnee, .first = 0, .last = 2, .forward = {}, .backward = {}};
  stretch.forward_miss_px = {3, 4};
  stretch.backward_miss_px = {0, 1};
  EXPECT_DOUBLE_EQ(mean_squared_miss({stretch}, kKnee), 26 / 4.0);
  EXPECT_TRUE(std::isnan(mean_squared_miss({stretch}, BodyPart::toe_l)));
}

}  // namespace
}  // namespace stride::tracking
