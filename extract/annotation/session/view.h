#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace stride::annotation {

/// The mapping between image and canvas. Both have their origin at the centre of the top left
/// pixel; the mapping is exact in double.
struct View {
  cv::Size image_px;                                // of the video
  cv::Rect area;                                    // of the canvas that shows the image
  double scale = 1;                                 // canvas pixels per image pixel
  Eigen::Vector2d p0_px = Eigen::Vector2d::Zero();  // image point at the corner of `area`

  Eigen::Vector2d to_canvas(const Eigen::Vector2d& image) const;
  Eigen::Vector2d to_image(const Eigen::Vector2d& canvas) const;
  bool contains(const Eigen::Vector2d& canvas) const;          // in `area`
  Eigen::Vector2d inside(const Eigen::Vector2d& image) const;  // the nearest point of the image

  /// The part of an image that `area` shows.
  cv::Mat piece_of(const cv::Mat& image) const;

  double fitting_scale() const;
  void fit();                                                  // the whole image, centred
  void zoom(double new_scale, const Eigen::Vector2d& canvas);  // keeps the point at `canvas`
  void pan(const Eigen::Vector2d& canvas_move);

 private:
  void keep_in_view();
};

}  // namespace stride::annotation
