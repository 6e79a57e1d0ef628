#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "videos/patch.h"

namespace stride::videos {

inline Eigen::Vector2d flat(const Eigen::Vector3d& p) { return {p.x(), p.y()}; }

/// A patch that hangs from a joint, rotated forward by `angle`.
inline Patch hanging(const Eigen::Vector3d& joint, double angle, std::vector<Station> stations) {
  Patch patch;
  patch.origin = flat(joint);
  patch.axis = {std::sin(angle), -std::cos(angle)};
  patch.front = {std::cos(angle), std::sin(angle)};
  patch.z_m = joint.z();
  patch.stations = std::move(stations);
  return patch;
}

/// An upright patch that leans forward by `lean`.
inline Patch upward(const Eigen::Vector3d& from, double lean, std::vector<Station> stations) {
  Patch patch;
  patch.origin = flat(from);
  patch.axis = {std::sin(lean), std::cos(lean)};
  patch.front = {std::cos(lean), -std::sin(lean)};
  patch.z_m = from.z();
  patch.stations = std::move(stations);
  return patch;
}

/// A patch along the sole: its axis points to the toes, its front up.
inline Patch along_foot(const Eigen::Vector3d& ankle, double angle, std::vector<Station> stations) {
  Patch patch;
  patch.origin = flat(ankle);
  patch.axis = {std::cos(angle), std::sin(angle)};
  patch.front = {-std::sin(angle), std::cos(angle)};
  patch.z_m = ankle.z();
  patch.stations = std::move(stations);
  return patch;
}

}  // namespace stride::videos
