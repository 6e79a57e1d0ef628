#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>

namespace stride::video {

/// Writes an mp4 (H.264), which gets its name when it is complete. Odd widths and heights are
/// padded by one pixel, because the encoder would crop them.
class VideoWriter {
 public:
  /// Throws Error naming the file and the value if `rate_hz` is not positive or the name does not
  /// end in .mp4.
  VideoWriter(const std::filesystem::path& file, double rate_hz);
  /// Removes the unfinished file unless finish() was called.
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// BGR, 8 bit, all of one size. Throws Error if the encoder cannot be opened or the size changes.
  void write(const cv::Mat& image);

  /// Closes the file and gives it its name. Throws Error if nothing was written.
  void finish();

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace stride::video
