#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "extract/video/container.h"

namespace stride::video {

struct VideoFrame {
  int index = -1;     // in decoding order, from 0
  double time_s = 0;  // of the runner: since the first frame, divided by the slow-motion factor
  cv::Mat image;      // BGR, 8 bit, upright, square pixels
};

struct VideoInfo {
  std::filesystem::path file;
  int width_px = 0, height_px = 0;  // of the returned frames
  int stored_width_px = 0;          // differs from width_px where stored pixels are not square
  double rate_hz = 0;               // as announced, times the slow-motion factor
  Turn turn;                        // of stored frames to those that are handed out
  double capture_rate_hz = 0;       // of the camera, as the file says; NaN: it does not
  std::vector<Edit> edits;          // how players show the recording
  int announced_frames = 0;         // what the container says, which is often wrong; 0: nothing
};

/// A video that is decoded in order, never by seeking, so frame numbers are exact. Each frame has
/// its own time stamp, because rates vary; stamps that do not grow, as the last ones of H.264
/// files, continue with the last step. Frames are turned upright by the rotation flag and widened
/// to square pixels.
class Video {
 public:
  /// `slow_motion`: 4 for a clip that shows one second in four. Throws Error if the file does not
  /// exist, is not a video, or is cut off so that nothing can be read.
  explicit Video(const std::filesystem::path& file, double slow_motion = 1);
  ~Video();
  Video(Video&&) noexcept;
  Video& operator=(Video&&) noexcept;

  const VideoInfo& info() const;

  /// The next frame; false after the last that can be decoded. Each call makes a new image, which
  /// the caller may keep.
  bool read(VideoFrame& frame);

  /// After the last frame: a sentence for the user if the container announced more frames than
  /// could be read, else empty.
  std::string shortfall() const;

 private:
  struct Decoder;
  std::unique_ptr<Decoder> decoder_;
};

/// Times of all frames that can be decoded, and what the file is.
struct VideoTimes {
  VideoInfo info;
  std::vector<double> times_s;
  std::string shortfall;  // as Video::shortfall()
};
VideoTimes video_times(const std::filesystem::path& video, double slow_motion);

/// Throws Error naming the cure where there is no such file, or it is a folder, an address or a
/// camera.
void require_video_file(const std::filesystem::path& file);

}  // namespace stride::video
