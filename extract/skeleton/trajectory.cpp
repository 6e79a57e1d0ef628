#include "extract/skeleton/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "extract/io/error.h"
#include "extract/io/table.h"
#include "extract/skeleton/movement.h"

namespace stride {
namespace {

constexpr int kVersion = 1;

int whole(double value, const std::string& what) {
  require(value >= 0 && value <= 1e9 && value == std::floor(value),
          "{} = {}: must be a whole number, 0 or more", what, value);
  return static_cast<int>(value);
}

/// What no trajectory of a video has: hand-made files, and tables of others with our names.
void check(const Trajectory& trajectory, const std::string& file) {
  require(!trajectory.frames.empty(), "{}: has no frames", file);
  constexpr double kMost = 25;  // between slow motion and a mistaken unit
  const TrajectoryFrame &first = trajectory.frames.front(), &last = trajectory.frames.back();
  if (trajectory.frames.size() > 1) {
    const double frame_s = (last.time_s - first.time_s) / std::max(last.frame - first.frame, 1);
    require(frame_s * trajectory.rate_hz < kMost && frame_s * trajectory.rate_hz > 1 / kMost,
            "{}: time_s grows by {:.4g} from frame to frame, rate_hz = {:.4g}: times must be in s",
            file, frame_s, trajectory.rate_hz);
  }
  constexpr double kFarthest_px = 1e6;
  for (const TrajectoryFrame& frame : trajectory.frames)
    for (const BodyPart part : kBodyParts) {
      const Point& point = frame[part];
      require(!(point.p_px.cwiseAbs().maxCoeff() > kFarthest_px),
              "{}: frame {}: {} = ({:.4g}, {:.4g}): lies in no picture", file, frame.frame,
              name(part), point.p_px.x(), point.p_px.y());
      require(point.confidence >= 0 && point.confidence <= 1 + 1e-6,
              "{}: frame {}: {}_confidence = {}: must be in [0, 1]", file, frame.frame, name(part),
              point.confidence);
    }
}

CalibrationLine line_in(const std::string& text, const std::string& what) {
  std::istringstream words(text);
  double frame = -1;
  CalibrationLine line;
  words >> frame >> line.from_px.x() >> line.from_px.y() >> line.to_px.x() >> line.to_px.y() >>
      line.length_m;
  require(!words.fail(), "{} = {}: must be a frame, x y x y in px, and a length in m", what, text);
  line.frame = whole(frame, what);
  check(line, what);
  return line;
}

}  // namespace

Trajectory load_trajectory(const std::filesystem::path& file) {
  const Table table =
      load_table(file, "trajectory", kVersion, "make one from the video with `stride track`");
  require(table.meta("unit") == "px", "{}: unit = '{}': a trajectory is in px", file.string(),
          table.meta("unit"));
  Trajectory trajectory;
  trajectory.video = table.meta("video");
  trajectory.video_sha256 = table.meta("video_sha256");
  trajectory.width_px = whole(table.meta_number("width_px"), file.string() + ": width_px");
  trajectory.height_px = whole(table.meta_number("height_px"), file.string() + ": height_px");
  trajectory.rate_hz = table.meta_number("rate_hz");
  const std::string direction = table.meta("direction");
  trajectory.direction = kFacings.find(direction);
  require(trajectory.direction || direction.empty(), "{}: direction = {}: must be {}",
          file.string(), direction, kFacings.list(" or "));
  if (table.has_meta("movement"))
    trajectory.movement = movement(table.meta("movement"), file.string() + ": movement").name;
  if (table.has_meta("floor_roll_rad"))
    trajectory.floor_roll_rad = table.meta_number("floor_roll_rad");
  if (table.has_meta("calibration_line"))
    trajectory.calibration_line =
        line_in(table.meta("calibration_line"), file.string() + ": calibration_line");
  require(std::isfinite(trajectory.rate_hz) && trajectory.rate_hz > 0,
          "{}: rate_hz = {}: must be positive", file.string(), trajectory.rate_hz);

  const std::size_t frame_column = table.column("frame"), time_column = table.column("time_s");
  double previous_s = -std::numeric_limits<double>::infinity();
  for (const auto& row : table.rows) {
    TrajectoryFrame& frame = trajectory.frames.emplace_back();
    frame.frame = whole(row[frame_column], file.string() + ": frame");
    frame.time_s = row[time_column];
    require(std::isfinite(frame.time_s) && frame.time_s > previous_s,
            "{}: frame {}: time_s = {}: must grow from row to row", file.string(), frame.frame,
            frame.time_s);
    previous_s = frame.time_s;
  }
  if (table.has_meta("treadmill")) {
    const std::string& said = table.meta("treadmill");
    require(said == "true" || said == "false", "{}: treadmill = {}: must be true or false",
            file.string(), said);
    trajectory.treadmill = said == "true";
  }
  if (table.has_column("camera_x")) {
    const std::size_t x = table.column("camera_x"), y = table.column("camera_y"),
                      residual = table.column("camera_residual");
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      trajectory.frames[i].camera_px = {table.rows[i][x], table.rows[i][y]};
      trajectory.frames[i].camera_residual_px = table.rows[i][residual];
    }
  }
  for (const BodyPart part : kBodyParts) {
    const std::string prefix(name(part));
    if (!table.has_column(prefix + "_x")) continue;
    const std::size_t x = table.column(prefix + "_x"), y = table.column(prefix + "_y"),
                      confidence = table.column(prefix + "_confidence");
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const auto& row = table.rows[i];
      Point& point = trajectory.frames[i][part];
      point.p_px = {row[x], row[y]};
      point.confidence = std::isnan(row[confidence]) ? 0 : row[confidence];
      if (point.present()) point.source = source_of(point.confidence);
      require(std::isnan(row[x]) == std::isnan(row[y]),
              "{}: frame {}: {} has x without y or y without x", file.string(),
              trajectory.frames[i].frame, prefix);
    }
  }
  check(trajectory, file.string());
  return trajectory;
}

std::vector<BodyPart> seen_parts(const Trajectory& trajectory) {
  return parts_in_file([&](BodyPart part) {
    return std::ranges::any_of(trajectory.frames,
                               [&](const TrajectoryFrame& frame) { return frame[part].present(); });
  });
}

Table table_of(const Trajectory& trajectory) {
  Table table;
  table.format = "trajectory";
  table.version = kVersion;
  table.set_meta("unit", "px");
  table.set_meta("video", trajectory.video);
  table.set_meta("video_sha256", trajectory.video_sha256);
  table.set_meta("width_px", fmt::format("{}", trajectory.width_px));
  table.set_meta("height_px", fmt::format("{}", trajectory.height_px));
  table.set_meta("rate_hz", fmt::format("{}", trajectory.rate_hz));
  table.set_meta("direction", std::string(name_or_empty(kFacings, trajectory.direction)));
  if (trajectory.movement != kDefaultMovement) table.set_meta("movement", trajectory.movement);
  if (std::isfinite(trajectory.floor_roll_rad))
    table.set_meta("floor_roll_rad", fmt::format("{}", trajectory.floor_roll_rad));
  if (const auto& line = trajectory.calibration_line)
    table.set_meta(
        "calibration_line",
        fmt::format("{} {} {} {} {} {}", line->frame, line->from_px.x(), line->from_px.y(),
                    line->to_px.x(), line->to_px.y(), line->length_m));
  if (trajectory.treadmill) table.set_meta("treadmill", *trajectory.treadmill ? "true" : "false");
  const bool camera = std::ranges::any_of(
      trajectory.frames, [](const TrajectoryFrame& f) { return f.camera_px.allFinite(); });
  const std::vector<BodyPart> parts = seen_parts(trajectory);
  table.columns = {"frame", "time_s"};
  for (const BodyPart part : parts)
    for (const char* suffix : {"x", "y", "confidence"})
      table.columns.push_back(fmt::format("{}_{}", name(part), suffix));
  if (camera)
    table.columns.insert(table.columns.end(), {"camera_x", "camera_y", "camera_residual"});
  for (const TrajectoryFrame& frame : trajectory.frames) {
    auto& row = table.rows.emplace_back(
        std::vector<double>{static_cast<double>(frame.frame), frame.time_s});
    for (const BodyPart part : parts) {
      const Point& point = frame[part];
      row.insert(row.end(), {point.p_px.x(), point.p_px.y(), point.confidence});
    }
    if (camera)
      row.insert(row.end(), {frame.camera_px.x(), frame.camera_px.y(), frame.camera_residual_px});
  }
  return table;
}

void save(const Trajectory& trajectory, const std::filesystem::path& file) {
  save(table_of(trajectory), file);
}

}  // namespace stride
