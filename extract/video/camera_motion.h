#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

namespace stride::video {

/// How the background moves from one frame to the next: q = scale · R(roll) · p + way, in pixels.
struct CameraStep {
  Eigen::Vector2d displacement_px = Eigen::Vector2d::Zero();  // way of the frame's centre
  double roll_rad = 0;
  double scale = 1;
  double residual_px = 0;  // median distance of the features that agree
  int features = 0;        // that agree; below 8 the step is not known and all else is as at rest

  bool known() const { return features >= 8; }
};

struct CameraOptions {
  int most_features = 80;
  int width_px = 320;         // wider images are made smaller first
  double agreement_px = 1.5;  // RANSAC threshold
};

/// The motion of the background, from corners outside the runner: Lucas–Kanade with a round-trip
/// check, partial affine by RANSAC, while frames come front to back. Where the background has
/// depth, this is the motion of the part of it that shows most corners.
class CameraTracker {
 public:
  explicit CameraTracker(CameraOptions options = {});

  /// The step from the frame before to this one; not known for the first. `runner`: the box that
  /// is left out.
  CameraStep add(const cv::Mat& bgr, const cv::Rect& runner);

 private:
  CameraOptions options_;
  std::vector<cv::Mat> before_;  // pyramid
  std::vector<cv::Point2f> corners_;
  int age_ = 0;  // frames since corners were looked for
};

}  // namespace stride::video
