#pragma once

#include <string>
#include <vector>

#include "calibrate/aperiodic/passage.h"
#include "extract/skeleton/trajectory.h"

namespace stride::aperiodic {

/// Where the runner is before the ground, in px of the image of the first frame: the camera's
/// motion is taken out, y is up from the ground at its slope.
struct GroundPath {
  std::vector<double> u_s;                              // of every frame
  std::vector<Eigen::Vector2d> pelvis_px;               // the midpoint of the hips
  std::vector<Eigen::Vector2d> com_px;                  // centre of mass, from segment masses
  std::array<std::vector<Eigen::Vector2d>, 4> feet_px;  // ankle and toe, right and left
  std::vector<double> clearance_px;                     // of the lower foot above where it stands
  double roll_rad = 0, roll_sd_rad = 0;                 // of the ground in the image, ccw
  double parallax = 1;  // the runner passes so many times as fast as the background
};

/// The one flight of a jump. Times are u_s. Without one `ok` is false, with `failure`.
struct Flight {
  bool ok = false;
  std::string failure;
  double take_off_s = 0, landing_s = 0;
  /// Free fall: the centre of mass falls with 9.81 m/s², which tells px a metre.
  double px_per_m = 0, relative_sd = 0;
  Eigen::Vector2d velocity_px_s = Eigen::Vector2d::Zero();  // of the centre of mass at take-off
  int flights = 0;                                          // how often both feet leave the ground
};

/// `roll`: what is known of the ground's slope in the mirrored image, with its deviation.
GroundPath ground_path(const Trajectory& trajectory, const fit::Marks& observations,
                       const PassageFit& fit, const Directions& directions, const fit::Prior& roll);

Flight find_flight(const GroundPath& path, const PassageFit& fit);

/// Shares of the body's mass, and where their centres lie along the segment (Winter 2009, table
/// 4.1, after Dempster 1955): of each foot, shank and thigh, and of head, arms and trunk.
struct Segment {
  double mass, along;
};
inline constexpr Segment kFoot{0.0145, 0.5}, kShank{0.0465, 0.433}, kThigh{0.100, 0.433},
    kUpper{0.678, 0.626};
/// The shoulders, to which the centre of the upper body refers, on the way from hips to head.
inline constexpr double kShoulders = 0.78;

}  // namespace stride::aperiodic
