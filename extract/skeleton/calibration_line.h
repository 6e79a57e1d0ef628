#pragma once

#include <Eigen/Core>
#include <string>

namespace stride {

/// A line of known length on one frame, in the plane in which the runner moves: marks on the floor,
/// or a person who stands.
struct CalibrationLine {
  int frame = 0;
  Eigen::Vector2d from_px = Eigen::Vector2d::Zero(), to_px = Eigen::Vector2d::Zero();
  double length_m = 0;

  double length_px() const { return (to_px - from_px).norm(); }
  double metres_per_pixel() const { return length_m / length_px(); }
  /// Of the scale: two clicks of a person on each end (1.5 px), and a line 15 cm before or behind
  /// the runner's plane at 10 m from the camera.
  double relative_sd() const;
};

/// The shortest line: below it two clicks tell the scale to no better than a fifth.
inline constexpr double kShortestLine_px = 10;

/// Throws Error, beginning with `what`, unless the line can be seen and its length is one.
void check(const CalibrationLine& line, const std::string& what);

/// "1.5 m on 214.3 px at frame 12: 7.00 mm per pixel".
std::string text_of(const CalibrationLine& line);

}  // namespace stride
