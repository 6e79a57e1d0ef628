#include "extract/pose/crop.h"

#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/imgproc.hpp>

namespace stride::pose {
namespace {

using Eigen::Vector2d;

TEST(Crop, LaysAPersonUprightWhereverTheBodyPoints) {
  for (const double angle : {0.0, 0.5, -1.2, 3.0}) {
    const Vector2d hips(300, 200), up(100 * std::sin(angle), -100 * std::cos(angle));
    const Crop crop = crop_of_person(hips, hips + up);
    EXPECT_NEAR(crop.size_px, 250, 1e-9);
    EXPECT_LT((crop.in_image({0.5, 0.5}) - hips).norm(), 1e-9);
    EXPECT_LT((crop.in_image({0.5, 0.1}) - (hips + up)).norm(), 1e-9);
  }
}

/// A picture of coloured spots, one at each place.
cv::Mat spots(cv::Size size, const std::vector<Vector2d>& places, double radius_px) {
  cv::Mat image(size, CV_8UC3, cv::Scalar::all(0));
  constexpr int kShift = 8;
  for (const Vector2d& p : places)
    cv::circle(image, {cvRound(p.x() * (1 << kShift)), cvRound(p.y() * (1 << kShift))},
               cvRound(radius_px * (1 << kShift)), {50, 100, 200}, cv::FILLED, cv::LINE_AA, kShift);
  return image;
}

class CropOfSize : public testing::TestWithParam<double> {};

TEST_P(CropOfSize, IsShownWithEveryPlaceWhereItSaysThatItIs) {
  constexpr int kSide = 64;
  const Crop crop{{410.3, 297.8}, GetParam(), 0.7};
  const Vector2d share(0.7, 0.35);
  const cv::Mat input =
      shown(spots({900, 600}, {crop.in_image(share)}, 0.08 * crop.size_px), crop, kSide, -1, 1);
  ASSERT_EQ(input.size[2], kSide);
  const auto channel = [&](int c) {
    return cv::Mat(kSide, kSide, CV_32F, const_cast<float*>(input.ptr<float>(0, c)));
  };
  const cv::Moments moments = cv::moments((channel(0) + 1) / 2);
  EXPECT_NEAR((moments.m10 / moments.m00 + 0.5) / kSide, share.x(), 0.004);
  EXPECT_NEAR((moments.m01 / moments.m00 + 0.5) / kSide, share.y(), 0.004);
  const int x = static_cast<int>(share.x() * kSide), y = static_cast<int>(share.y() * kSide);
  EXPECT_NEAR(channel(0).at<float>(y, x), 2 * 200 / 255.0 - 1, 0.02);  // red first
  EXPECT_NEAR(channel(2).at<float>(y, x), 2 * 50 / 255.0 - 1, 0.02);
}

INSTANTIATE_TEST_SUITE_P(All, CropOfSize, testing::Values(60.0, 100.0, 250.0, 420.0));

TEST(Crop, IsBlackBeyondThePicture) {
  const cv::Mat white(100, 100, CV_8UC3, cv::Scalar::all(255));
  const cv::Mat input = shown(white, {{0, 0}, 80, 0}, 16, 0, 1);
  EXPECT_EQ(input.ptr<float>(0, 0)[0], 0);
  EXPECT_NEAR(input.ptr<float>(0, 0)[16 * 16 - 1], 1, 1e-6);
  EXPECT_EQ(cv::countNonZero(shown(white, {{500, 500}, 400, 0}, 16, 0, 1).reshape(1, 1)), 0);
}

}  // namespace
}  // namespace stride::pose
