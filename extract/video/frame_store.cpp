#include "extract/video/frame_store.h"

#include <chrono>
#include <opencv2/imgcodecs.hpp>
#include <utility>

namespace stride::video {

FrameStore::FrameStore(const std::filesystem::path& file, double most_bytes) {
  Video video(file);
  info_ = video.info();
  compressed_ = info_.announced_frames <= 0 ||
                3.0 * info_.width_px * info_.height_px * info_.announced_frames > most_bytes;
  thread_ = std::thread([this, opened = std::move(video)]() mutable { decode(std::move(opened)); });
}

FrameStore::~FrameStore() {
  stop_ = true;
  thread_.join();
}

void FrameStore::decode(Video video) {
  VideoFrame frame;
  while (!stop_ && video.read(frame)) {
    cv::Mat held = frame.image;
    if (compressed_) {
      std::vector<unsigned char> bytes;
      cv::imencode(".jpg", frame.image, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
      held = cv::Mat(bytes, true).reshape(1, 1);
    }
    const std::lock_guard lock(mutex_);
    frames_.push_back(held);
    times_s_.push_back(frame.time_s);
    ++count_;
  }
  const std::lock_guard lock(mutex_);
  shortfall_ = video.shortfall();
  complete_ = true;
}

void FrameStore::wait() {
  while (!complete_) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

std::string FrameStore::shortfall() const {
  const std::lock_guard lock(mutex_);
  return shortfall_;
}

cv::Mat FrameStore::image(int frame) const {
  cv::Mat held;
  {
    const std::lock_guard lock(mutex_);
    held = frames_.at(static_cast<std::size_t>(frame));
  }
  return compressed_ ? cv::imdecode(held, cv::IMREAD_COLOR) : held;
}

double FrameStore::video_time_s(int frame) const {
  const std::lock_guard lock(mutex_);
  return times_s_.at(static_cast<std::size_t>(frame));
}

}  // namespace stride::video
