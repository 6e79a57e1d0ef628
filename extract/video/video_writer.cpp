#include "extract/video/video_writer.h"

#include <unistd.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "extract/io/error.h"
#include "extract/video/container.h"

namespace stride::video {
namespace fs = std::filesystem;

struct VideoWriter::Encoder {
  fs::path file, unfinished;
  double rate_hz = 0;
  cv::Size size;
  cv::VideoWriter writer;

  void open(cv::Size image_size) {
    std::error_code error;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
    size = image_size;
    const cv::Size even(size.width + size.width % 2, size.height + size.height % 2);
    require(writer.open(ffmpeg_name(unfinished), cv::CAP_FFMPEG,
                        cv::VideoWriter::fourcc('a', 'v', 'c', '1'), rate_hz, even),
            "{}: the video cannot be written ({}×{} px, {} Hz); is the folder writable?",
            file.string(), even.width, even.height, rate_hz);
  }
};

VideoWriter::VideoWriter(const fs::path& file, double rate_hz)
    : encoder_(std::make_unique<Encoder>()) {
  require(file.extension() == ".mp4", "{}: videos are written as .mp4; change the name",
          file.string());
  require(std::isfinite(rate_hz) && rate_hz > 0, "{}: rate_hz = {}: must be positive",
          file.string(), rate_hz);
  encoder_->file = file;
  encoder_->unfinished =
      file.parent_path() / fmt::format(".{}.{}.mp4", file.stem().string(), ::getpid());
  encoder_->rate_hz = rate_hz;
}

VideoWriter::~VideoWriter() {
  if (!encoder_->writer.isOpened()) return;
  encoder_->writer.release();
  std::error_code ignored;
  fs::remove(encoder_->unfinished, ignored);
}

void VideoWriter::write(const cv::Mat& image) {
  Encoder& e = *encoder_;
  if (!e.writer.isOpened()) e.open(image.size());
  require(image.size() == e.size && image.type() == CV_8UC3,
          "{}: a frame of {}×{} px with {} channels: must be {}×{} px with 3", e.file.string(),
          image.cols, image.rows, image.channels(), e.size.width, e.size.height);
  if (image.cols % 2 == 0 && image.rows % 2 == 0) {
    e.writer.write(image);
    return;
  }
  cv::Mat even;
  cv::copyMakeBorder(image, even, 0, image.rows % 2, 0, image.cols % 2, cv::BORDER_REPLICATE);
  e.writer.write(even);
}

void VideoWriter::finish() {
  Encoder& e = *encoder_;
  require(e.writer.isOpened(), "{}: no frame was written", e.file.string());
  e.writer.release();
  std::error_code error;
  fs::rename(e.unfinished, e.file, error);
  require(!error, "{}: cannot be written ({})", e.file.string(), error.message());
}

}  // namespace stride::video
