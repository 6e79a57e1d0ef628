#include "extract/video/camera_motion.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace stride {
namespace {

/// A textured plane seen by a camera that moved and rolled.
cv::Mat view(double x_px, double y_px, double roll_deg, double scale) {
  cv::Mat texture(480, 640, CV_8UC3), image;
  cv::theRNG().state = 7;
  cv::randu(texture, 0, 255);
  cv::GaussianBlur(texture, texture, {0, 0}, 4);
  cv::normalize(texture, texture, 0, 255, cv::NORM_MINMAX);
  cv::Mat turn = cv::getRotationMatrix2D({319.5F, 239.5F}, roll_deg, scale);
  turn.at<double>(0, 2) += x_px;
  turn.at<double>(1, 2) += y_px;
  cv::warpAffine(texture, image, turn, texture.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return image;
}

TEST(Camera, MeasuresWayRollAndScaleOfTheBackground) {
  video::CameraTracker tracker;
  EXPECT_FALSE(tracker.add(view(0, 0, 0, 1), {}).known());
  const video::CameraStep step = tracker.add(view(-6.5, 2.25, -0.5, 1.01), {});
  ASSERT_TRUE(step.known());
  EXPECT_NEAR(step.displacement_px.x(), -6.5, 0.15);
  EXPECT_NEAR(step.displacement_px.y(), 2.25, 0.15);
  EXPECT_NEAR(step.roll_rad, 0.5 * CV_PI / 180, 1e-3);  // OpenCV turns against the clock, y down
  EXPECT_NEAR(step.scale, 1.01, 1e-3);
  EXPECT_LT(step.residual_px, 0.3);
}

TEST(Camera, LeavesTheRunnerOut) {
  const cv::Rect runner(200, 60, 220, 380);
  video::CameraTracker tracker;
  cv::Mat first = view(0, 0, 0, 1), second = view(-4, 0, 0, 1);
  view(9, 9, 0, 1)(runner).copyTo(first(runner));
  view(3, -8, 0, 1)(runner).copyTo(second(runner));
  tracker.add(first, runner);
  const video::CameraStep step = tracker.add(second, runner);
  ASSERT_TRUE(step.known());
  EXPECT_NEAR(step.displacement_px.x(), -4, 0.15);
  EXPECT_NEAR(step.displacement_px.y(), 0, 0.15);
}

TEST(Camera, SaysThatAPlainBackgroundTellsNothing) {
  video::CameraTracker tracker;
  const cv::Mat plain(360, 640, CV_8UC3, cv::Scalar::all(90));
  tracker.add(plain, {});
  EXPECT_FALSE(tracker.add(plain, {}).known());
}

}  // namespace
}  // namespace stride
