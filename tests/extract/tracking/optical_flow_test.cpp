#include "extract/tracking/optical_flow.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "extract/io/random.h"

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr BodyPart kPart = BodyPart::knee_r;
const Vector2d kFrom(60, 80), kStep(1.75, -0.5);  // px, px a frame

Vector2d place(int frame) { return kFrom + frame * kStep; }

/// A blurred random texture that moves by kStep a frame.
std::vector<video::RunnerCrop> moving_texture(int frames) {
  Random random(3);
  cv::Mat texture(160, 200, CV_8U);
  for (auto it = texture.begin<unsigned char>(); it != texture.end<unsigned char>(); ++it)
    *it = static_cast<unsigned char>(255 * uniform(random));
  cv::GaussianBlur(texture, texture, {9, 9}, 2);
  cv::normalize(texture, texture, 0, 255, cv::NORM_MINMAX);
  std::vector<video::RunnerCrop> crops;
  for (int f = 0; f < frames; ++f) {
    const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, f * kStep.x(), 0, 1, f * kStep.y());
    video::RunnerCrop& crop = crops.emplace_back();
    cv::warpAffine(texture, crop.gray, shift, texture.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  }
  return crops;
}

Trajectory ends(int last, const Vector2d& off = Vector2d::Zero()) {
  Trajectory marks;
  for (const int f : {0, last}) {
    TrajectoryFrame& frame = marks.frames.emplace_back();
    frame.frame = f;
    frame[kPart] = {place(f) + (f > 0 ? off : Vector2d(0, 0)), Source::clicked, 1};
  }
  return marks;
}

TEST(OpticalFlow, FollowsATextureFromBothEnds) {
  const int last = 8;
  const ExpectedPlace expected = [](BodyPart, int frame) -> Vector2d {
    return place(frame) + Vector2d(1.5, 1);
  };
  const std::vector<FlowStretch> found = follow(ends(last), moving_texture(last + 1), expected);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first, 0);
  EXPECT_EQ(found[0].last, last);
  for (const auto* steps : {&found[0].forward, &found[0].backward}) {
    ASSERT_EQ(steps->size(), static_cast<std::size_t>(last));
    for (const FlowStep& step : *steps) {
      EXPECT_TRUE(step.inlier);
      EXPECT_LT((step.displacement_px - kStep).norm(), 0.1);
      EXPECT_LT(step.round_trip_px, 0.1);
    }
  }
  EXPECT_LT(found[0].forward_miss_px.norm(), 0.4);
  EXPECT_LT(found[0].backward_miss_px.norm(), 0.4);
}

TEST(OpticalFlow, MissesAClickThatIsBesideTheTexturesPath) {
  const Vector2d off(3, 2);
  const ExpectedPlace expected = [](BodyPart, int frame) { return place(frame); };
  const auto found = follow(ends(6, off), moving_texture(7), expected);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT((found[0].forward_miss_px + off).norm(), 0.5);  // arrival minus labelled point
}

TEST(OpticalFlow, TakesThePriorsDisplacementWhereThePictureSaysNothing) {
  std::vector<video::RunnerCrop> crops = moving_texture(5);
  for (video::RunnerCrop& crop : crops) crop.gray.setTo(90);
  const ExpectedPlace expected = [](BodyPart, int frame) { return place(frame); };
  const auto found = follow(ends(4), crops, expected);
  ASSERT_EQ(found.size(), 1U);
  for (const FlowStep& step : found[0].forward) {
    EXPECT_FALSE(step.inlier);
    EXPECT_LT((step.displacement_px - kStep).norm(), 1e-9);
  }
}

TEST(OpticalFlow, DoesNotCrossALongGap) {
  const ExpectedPlace expected = [](BodyPart, int frame) { return place(frame); };
  FlowOptions options;
  options.longest_gap_frames = 3;
  EXPECT_TRUE(follow(ends(4), moving_texture(5), expected, options).empty());
}

}  // namespace
}  // namespace stride::tracking
