#include "train/film/film_source.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/support/throws.h"

namespace stride {
namespace {

const std::filesystem::path kVideo = std::filesystem::path(STRIDE_SOURCE_DIR) / "videos/human.mp4";
constexpr double kPeriod_s = 0.6867;

TEST(SourceStride, LoopsOverOneStride) {
  const film::SourceStride stride = film::read_source_stride(kVideo, 0.7, kPeriod_s);
  // 30 frames a second.
  EXPECT_NEAR(static_cast<double>(stride.frames.size()), kPeriod_s * 30, 1);
  EXPECT_EQ(stride.at(0.02).data, stride.at(3.02).data);
  EXPECT_EQ(stride.at(-0.001).data, stride.at(0.999).data);
  EXPECT_NE(stride.at(0).data, stride.at(0.5).data);
  for (std::size_t i = 0; i < stride.phase.size(); ++i)
    EXPECT_EQ(stride.at(stride.phase[i] + 0.001).data, stride.frames[i].data);
}

TEST(SourceStride, KeepsThePelvisInTheMiddleOfItsWindow) {
  const Trajectory truth = load_trajectory(kVideo.parent_path() / "human.truth.csv");
  const film::SourceStride whole = film::read_source_stride(kVideo, 0.7, kPeriod_s),
                           cut = film::read_source_stride(kVideo, 0.7, kPeriod_s, 1, &truth, 0.8);
  EXPECT_EQ(cut.frames[0].size(), cv::Size(288, 360));
  for (std::size_t i = 0; i < cut.frames.size(); ++i) {
    const int pelvis =
        static_cast<int>(std::lround(truth.frames[21 + i][BodyPart::pelvis].p_px.x()));
    EXPECT_EQ(
        cv::norm(cut.frames[i], whole.frames[i](cv::Rect(pelvis - 144, 0, 288, 360)), cv::NORM_INF),
        0);
  }
}

TEST(SourceStride, MirrorsARunToTheLeft) {
  const auto video = kVideo.parent_path() / "left.mp4";
  const Trajectory truth = load_trajectory(kVideo.parent_path() / "left.truth.csv");
  const cv::Mat whole = film::read_source_stride(video, 0.7, kPeriod_s).frames[0];
  const cv::Mat cut = film::read_source_stride(video, 0.7, kPeriod_s, 1, &truth, 1).frames[0];
  const int pelvis = static_cast<int>(std::lround(truth.frames[21][BodyPart::pelvis].p_px.x()));
  cv::Mat expected;
  cv::flip(whole(cv::Rect(pelvis - 180, 0, 360, 360)), expected, 1);
  EXPECT_EQ(cv::norm(cut, expected, cv::NORM_INF), 0);
}

TEST(SourceStride, SaysWhenTheVideoEndsBeforeTheStrideDoes) {
  EXPECT_ERROR(film::read_source_stride(kVideo, 3.0, kPeriod_s), "human.mp4");
}

TEST(SideBySide, HasTheHeightOfTheRunnerAndAnEvenWidth) {
  const cv::Mat left(1080, 811, CV_8UC3, cv::Scalar(1, 2, 3)),
      right(360, 641, CV_8UC3, cv::Scalar(4, 5, 6));
  const cv::Mat both = film::side_by_side(left, right);
  EXPECT_EQ(both.rows, 360);
  EXPECT_EQ(both.cols % 2, 0);
  EXPECT_EQ(both.at<cv::Vec3b>(100, 100), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(both.at<cv::Vec3b>(100, both.cols - 1), cv::Vec3b(4, 5, 6));
}

}  // namespace
}  // namespace stride
