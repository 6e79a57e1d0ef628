#pragma once

#include <Eigen/Core>

namespace stride::videos {

/// A pinhole camera beside the track, looking across it. World axes as in skeleton.h, image axes as
/// in extract/skeleton/trajectory.h.
struct PinholeCamera {
  int width_px = 640, height_px = 360;
  double focal_px = 1800;
  double distance_m = 14;  // from the plane z = 0 in which the runner runs
  double x_m = 0, height_m = 1.1;
  double center_u_px = 320, center_v_px = 165;  // principal point: the horizon lies on it
  double roll_rad = 0;      // positive: the image of the ground rises to the right
  double pixel_aspect = 1;  // width of a pixel over its height
  bool from_left = false;   // on the runner's left: the run goes to the left of the image

  double direction() const { return from_left ? -1 : 1; }
  /// Depth of a plane z = const.
  double depth(double z_m) const { return distance_m - direction() * z_m; }
  /// Of the plane z = 0, at the principal point and vertically.
  double metres_per_pixel() const { return distance_m / focal_px; }

  Eigen::Vector2d project(const Eigen::Vector3d& p_m) const;
  /// Removes the roll from a pixel: u right, v down, px.
  Eigen::Vector2d upright(double u_px, double v_px) const;
  /// The point of the plane z = const at a pixel.
  Eigen::Vector2d on_plane(double u_px, double v_px, double z_m) const;
};

}  // namespace stride::videos
