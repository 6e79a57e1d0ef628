#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

namespace stride::video {

/// Motion of the background between two frames: q = scale · R(roll) · p + displacement, px.
struct CameraStep {
  Eigen::Vector2d displacement_px = Eigen::Vector2d::Zero();  // of the frame's centre
  double roll_rad = 0;
  double scale = 1;
  double residual_px = 0;  // median distance of the inliers
  int features = 0;        // inliers; below 8 the step is unknown and everything else is as at rest

  bool known() const { return features >= 8; }
};

struct CameraOptions {
  int most_features = 80;
  int width_px = 320;         // wider images are reduced to it
  double agreement_px = 1.5;  // RANSAC threshold
};

/// Motion of the background from corners outside the runner: Lucas–Kanade with a forward–backward
/// check, then a partial affine motion by RANSAC. Frames come in order. Where the background has
/// depth, this is the motion of the layer with most corners.
class CameraTracker {
 public:
  explicit CameraTracker(CameraOptions options = {});

  /// The step from the previous frame to this one; unknown for the first. `runner`: the box that is
  /// excluded.
  CameraStep add(const cv::Mat& bgr, const cv::Rect& runner);

 private:
  CameraOptions options_;
  std::vector<cv::Mat> before_;  // pyramid
  std::vector<cv::Point2f> corners_;
  int age_ = 0;  // frames since corners were detected
};

}  // namespace stride::video
