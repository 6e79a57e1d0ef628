#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "extract/io/table.h"
#include "extract/skeleton/body_part.h"
#include "extract/skeleton/calibration_line.h"
#include "extract/skeleton/facing.h"

namespace stride {

/// Where a point comes from.
enum class Source {
  unknown,    // nothing was said of the part
  clicked,    // a person sees it there
  hidden,     // a person estimates it: the part is covered
  detected,   // a pose network or another program found it
  tracked,    // followed through the picture from another frame
  predicted,  // seen by nobody: the gait says that it is there
  absent      // a person says that it is not to be seen; without a position
};

/// The confidence of a point that is only predicted is at most this.
inline constexpr double kPredictedConfidence = 0.3;
inline constexpr double kHiddenConfidence = 0.5;  // of a point that a person estimates

/// Files have the confidence alone: what it says of the source of a point with a position. 1 counts
/// as clicked, up to kPredictedConfidence as predicted.
constexpr Source source_of(double confidence) {
  return confidence >= 1                     ? Source::clicked
         : confidence > kPredictedConfidence ? Source::tracked
                                             : Source::predicted;
}

/// A point on a frame, in pixels of the decoded frame: x right, y down, (0, 0) the centre of
/// the top left pixel.
struct Point {
  Eigen::Vector2d p_px =
      Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());  // NaN: absent
  Source source = Source::unknown;
  double confidence = 0;  // 1 clicked … 0 nothing but the prior

  bool present() const { return p_px.allFinite(); }
  /// Whether it was seen, by a person or in the picture: not so if a detector was very unsure.
  bool seen() const { return present() && confidence > kPredictedConfidence; }
};

struct TrajectoryFrame {
  int frame = 0;      // index in decoding order, from 0
  double time_s = 0;  // of the runner: presentation time divided by the slow-motion factor
  std::array<Point, kBodyPartCount> points;
  /// Displacement of the background's centre since the previous frame, and median residual of its
  /// corners; NaN: unknown.
  Eigen::Vector2d camera_px = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  double camera_residual_px = std::numeric_limits<double>::quiet_NaN();

  const Point& operator[](BodyPart part) const { return points[index(part)]; }
  Point& operator[](BodyPart part) { return points[index(part)]; }
};

/// Every part of one runner in every frame from the first click to the last: the result of
/// `extract/`.
struct Trajectory {
  std::string video;  // file name of the source
  std::string video_sha256;
  int width_px = 0, height_px = 0;
  double rate_hz = 0;               // median frame rate of the runner's time
  std::optional<Facing> direction;  // none: not known
  double floor_roll_rad =
      std::numeric_limits<double>::quiet_NaN();  // slope of a marked floor line; NaN: none
  std::optional<CalibrationLine> calibration_line;
  std::string movement = "run";   // a name of movements.toml
  std::optional<bool> treadmill;  // the runner stays in place before a background at rest
  std::vector<TrajectoryFrame> frames;
};

/// NAME.trajectory.csv: `# stride trajectory 1`, unit px, columns frame, time_s, <part>_x,
/// <part>_y, <part>_confidence, and camera_x, camera_y, camera_residual where known. Errors name
/// the file, and the cure where the file is a calibrated trajectory instead. Times that are not in
/// s, points in no picture and confidences outside [0, 1] are errors too.
Trajectory load_trajectory(const std::filesystem::path& file);
void save(const Trajectory& trajectory, const std::filesystem::path& file);

/// The parts whose columns a file of the trajectory has.
std::vector<BodyPart> seen_parts(const Trajectory& trajectory);

/// The content that save() writes.
Table table_of(const Trajectory& trajectory);

}  // namespace stride
