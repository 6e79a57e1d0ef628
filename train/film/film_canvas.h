#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "train/simulation/engine/engine.h"

namespace stride::film {

inline constexpr int kOversampling = 2;     // drawn so much larger, then averaged down
inline constexpr double kGroundRow = 0.86;  // of the picture's height, where y = 0

cv::Scalar mixed(const cv::Scalar& a, const cv::Scalar& b, double weight);

simulation::PlanarVector between(simulation::PlanarVector a, simulation::PlanarVector b,
                                 double weight);

/// A canvas in axes of the ground, in metres, with anti-aliasing.
class Canvas {
 public:
  /// Of that size times kOversampling.
  Canvas(cv::Size size_px, double metres_high, double centre_x_m);

  cv::Mat& picture() { return picture_; }
  double left_m() const { return centre_x_m_ - picture_.cols / 2.0 / scale_; }
  double right_m() const { return centre_x_m_ + picture_.cols / 2.0 / scale_; }
  cv::Point2d place(simulation::PlanarVector p) const;

  void disc(simulation::PlanarVector p, double radius_m, const cv::Scalar& colour, int rim_px = -1);
  void shape(const std::vector<simulation::PlanarVector>& outline, const cv::Scalar& colour);
  void line(simulation::PlanarVector a, simulation::PlanarVector b, double width_m,
            const cv::Scalar& colour);

  /// A limb's bone from a to b, thicker at its ends, with a rim.
  void bone(simulation::PlanarVector a, simulation::PlanarVector b, double end_m, double waist_m,
            const cv::Scalar& fill, const cv::Scalar& rim);
  /// A tapered piece of the body's outline around the bones.
  void flesh(simulation::PlanarVector a, simulation::PlanarVector b, double radius_a_m,
             double radius_b_m, const cv::Scalar& colour);
  /// A thin tendon with a belly, along the points of a muscle's path.
  void muscle(const std::vector<simulation::PlanarVector>& path, double belly_m,
              const cv::Scalar& colour);

 private:
  cv::Mat picture_;
  double scale_, centre_x_m_;
};

}  // namespace stride::film
