#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace stride::pose {

/// A square of an image, turned: what a network is shown.
struct Crop {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();  // as in Point
  double size_px = 0;                                   // of its side
  double angle_rad = 0;  // of its downward side to the image's, clockwise

  /// Place in the image of (x, y) in [0, 1]²: across and down the square.
  Eigen::Vector2d in_image(const Eigen::Vector2d& share) const;
};

/// The crop around a person: `centre` is the middle of the hips, `above` the point over it on the
/// circle around the whole body.
Crop crop_of_person(const Eigen::Vector2d& centre_px, const Eigen::Vector2d& above_px);

/// The square that holds a whole image.
Crop crop_of_image(const cv::Mat& image);

/// The crop of an image (BGR, 8 bit) as `side` × `side` RGB floats, levels 0 … 255 mapped to
/// [low, high]; black beyond the image. As a network takes it: 1 × 3 × side × side.
cv::Mat shown(const cv::Mat& bgr, const Crop& crop, int side, double low, double high);

}  // namespace stride::pose
