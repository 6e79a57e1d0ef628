#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "extract/video/edit_list.h"

struct AVFormatContext;

namespace stride::video {

/// How stored frames are turned to stand upright: first transposed, then mirrored.
struct Turn {
  bool transpose = false, mirror_x = false, mirror_y = false;

  bool is_none() const { return !transpose && !mirror_x && !mirror_y; }
};

/// What the header of a video file says of its first video stream.
struct Container {
  std::string format, codec;  // as FFmpeg calls them: "mov,mp4,…", "h264"
  Turn turn;                  // by the display matrix, as phones write it
  double capture_rate_hz =    // of the camera, where that differs from the rate at which it plays
      std::numeric_limits<double>::quiet_NaN();
  std::vector<Edit> edits;  // how players show the recording
};

/// Reads the header alone. Nothing is known of a file that FFmpeg cannot read.
Container read_container(const std::filesystem::path& file);

/// Closes what avformat_open_input() opened.
struct CloseInput {
  void operator()(AVFormatContext* context) const;
};

/// The name of a file as FFmpeg and OpenCV take it: never as the address of a network stream, which
/// a name such as `10:30.mp4` would be.
std::string ffmpeg_name(const std::filesystem::path& file);

/// In degrees clockwise, for a person: "turned by 90 degrees", "mirrored"; empty: upright.
std::string text_of(const Turn& turn);

}  // namespace stride::video
