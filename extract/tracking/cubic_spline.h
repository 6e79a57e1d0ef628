#pragma once

#include <Eigen/Core>
#include <vector>

namespace stride::tracking {

/// The cubic spline through points in the plane with not-a-knot ends; for fewer than four points
/// the interpolating polynomial; linear outside the points.
class CubicSpline {
 public:
  /// `t` grows strictly and is as long as `p`, at least 1.
  CubicSpline(std::vector<double> t, std::vector<Eigen::Vector2d> p);

  Eigen::Vector2d operator()(double t) const;

 private:
  std::vector<double> t_;
  std::vector<Eigen::Vector2d> p_, slope_;  // the spline as Hermite pieces
};

}  // namespace stride::tracking
