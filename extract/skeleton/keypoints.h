#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "extract/skeleton/body_part.h"
#include "extract/skeleton/calibration_line.h"
#include "extract/skeleton/facing.h"

namespace stride {

/// The state of a click.
enum class ClickState {
  seen,       // visible
  estimated,  // hidden; the position is an estimate
  absent      // hidden or outside the frame, position unknown
};
inline constexpr Names<ClickState> kClickStates({{ClickState::seen, "seen"},
                                                 {ClickState::estimated, "estimated"},
                                                 {ClickState::absent, "absent"}});

struct Click {
  Eigen::Vector2d p_px = Eigen::Vector2d::Zero();  // as Point::p_px; meaningless if absent
  ClickState state = ClickState::seen;
  std::string other_json;  // unknown keys, an object or empty
};

struct ClickedFrame {
  double time_s = 0;  // as VideoFrame::time_s
  std::array<std::optional<Click>, kBodyPartCount> clicks;
  std::string other_json;

  const std::optional<Click>& operator[](BodyPart part) const { return clicks[index(part)]; }
  std::optional<Click>& operator[](BodyPart part) { return clicks[index(part)]; }
  /// Whether there is a click with a position: seen or estimated.
  bool placed(BodyPart part) const {
    const auto& click = clicks[index(part)];
    return click && click->state != ClickState::absent;
  }
};

struct FrameRange {
  int first = 0, last = 0;  // both included
};

struct FloorLine {
  Eigen::Vector2d from_px = Eigen::Vector2d::Zero(), to_px = Eigen::Vector2d::Zero();
};

/// The clicks on a video: NAME.keypoints.json. Parts are matched by name, frames by number, nothing
/// by order.
struct Keypoints {
  std::string video;         // file name, without folder
  std::string video_sha256;  // of the file's bytes
  int width_px = 0, height_px = 0;
  std::string movement = "run";     // a name of movements.toml
  std::optional<Facing> direction;  // none: not said
  std::optional<Side> near_leg;     // the leg nearer to the camera; none: not said
  double slow_motion = 1;           // seconds of video per second of the runner
  std::optional<bool> treadmill;
  std::optional<FrameRange> trim;  // only these frames are used
  std::optional<FloorLine> floor;
  std::optional<CalibrationLine> calibration_line;
  bool corrects_network = false;  // the clicks correct a pose network's points on all frames
  std::string notes;
  std::map<int, ClickedFrame> frames;  // by frame number
  std::string other_json;              // unknown keys, kept as they are
};

/// Reads NAME.keypoints.json. Errors name file, frame, part, value and rule: a newer version, an
/// unknown part, a click outside the frame, an invalid number.
Keypoints load_keypoints(const std::filesystem::path& file);

/// Checks as load_keypoints does, then replaces the file atomically. Throws Error.
void save(const Keypoints& keypoints, const std::filesystem::path& file);

/// The content that save() writes.
std::string text_of(const Keypoints& keypoints);

/// Checks the rules of the format. Throws Error, beginning with `what`.
void check(const Keypoints& keypoints, const std::string& what);

/// Throws Error unless the keypoints belong to this video, by its SHA-256.
void check_belongs_to(const Keypoints& keypoints, const std::filesystem::path& video);

/// NAME.keypoints.json beside the video.
std::filesystem::path keypoints_file_of(const std::filesystem::path& video);

}  // namespace stride
