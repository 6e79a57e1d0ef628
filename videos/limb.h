#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "videos/patch.h"

namespace stride::videos {

inline Eigen::Vector2d flat(const Eigen::Vector3d& p) { return {p.x(), p.y()}; }

/// A patch from a joint along a unit vector `axis`.
inline Patch patch_along(const Eigen::Vector3d& joint, const Eigen::Vector2d& axis,
                         const Eigen::Vector2d& front, std::vector<Station> stations) {
  Patch patch;
  patch.origin = flat(joint);
  patch.axis = axis;
  patch.front = front;
  patch.z_m = joint.z();
  patch.stations = std::move(stations);
  return patch;
}

/// A patch that hangs from a joint, rotated forward by `angle`.
inline Patch hanging(const Eigen::Vector3d& joint, double angle, std::vector<Station> stations) {
  return patch_along(joint, {std::sin(angle), -std::cos(angle)}, {std::cos(angle), std::sin(angle)},
                     std::move(stations));
}

/// An upright patch that leans forward by `lean`.
inline Patch upward(const Eigen::Vector3d& from, double lean, std::vector<Station> stations) {
  return patch_along(from, {std::sin(lean), std::cos(lean)}, {std::cos(lean), -std::sin(lean)},
                     std::move(stations));
}

/// A patch along the sole: its axis points to the toes, its front up.
inline Patch along_foot(const Eigen::Vector3d& ankle, double angle, std::vector<Station> stations) {
  return patch_along(ankle, {std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)},
                     std::move(stations));
}

}  // namespace stride::videos
