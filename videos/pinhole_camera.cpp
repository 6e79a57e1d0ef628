#include "videos/pinhole_camera.h"

#include <cmath>

namespace stride::videos {

using Eigen::Vector2d;

Vector2d PinholeCamera::project(const Eigen::Vector3d& p_m) const {
  const double scale = focal_px / depth(p_m.z());
  const double u = scale * direction() * (p_m.x() - x_m), v = -scale * (p_m.y() - height_m);
  const double c = std::cos(roll_rad), s = std::sin(roll_rad);
  return {center_u_px + (u * c + v * s) / pixel_aspect, center_v_px - u * s + v * c};
}

Vector2d PinholeCamera::upright(double u_px, double v_px) const {
  const double u = (u_px - center_u_px) * pixel_aspect, v = v_px - center_v_px;
  const double c = std::cos(roll_rad), s = std::sin(roll_rad);
  return {u * c - v * s, u * s + v * c};
}

Vector2d PinholeCamera::on_plane(double u_px, double v_px, double z_m) const {
  const Vector2d uv = upright(u_px, v_px) * (depth(z_m) / focal_px);
  return {x_m + direction() * uv.x(), height_m - uv.y()};
}

}  // namespace stride::videos
