#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <string>
#include <thread>
#include <vector>

#include "extract/video/video.h"

namespace stride::video {

/// Random access to the frames of a video, which a thread decodes once, in order. Large clips are
/// held as JPEG of high quality.
class FrameStore {
 public:
  /// Throws Error as Video does. `info()` is available at once, frames follow. `most_bytes`: of
  /// images that are held as they are.
  explicit FrameStore(const std::filesystem::path& video, double most_bytes = 800e6);
  ~FrameStore();
  FrameStore(const FrameStore&) = delete;
  FrameStore& operator=(const FrameStore&) = delete;

  const VideoInfo& info() const { return info_; }
  int count() const { return count_; }         // frames decoded so far
  bool complete() const { return complete_; }  // count() is final
  void wait();                                 // until complete
  std::string shortfall() const;               // as Video::shortfall(), once complete

  /// Requires frame < count(). BGR; the caller must not write to it. Thread-safe.
  cv::Mat image(int frame) const;
  double video_time_s(int frame) const;

 private:
  void decode(Video video);

  VideoInfo info_;
  bool compressed_ = false;
  mutable std::mutex mutex_;     // of the frames and times
  std::vector<cv::Mat> frames_;  // images, or one row of JPEG bytes
  std::vector<double> times_s_;
  std::string shortfall_;
  std::atomic<int> count_ = 0;
  std::atomic<bool> complete_ = false, stop_ = false;
  std::thread thread_;
};

}  // namespace stride::video
