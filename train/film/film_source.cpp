#include "train/film/film_source.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "extract/io/error.h"
#include "extract/video/video.h"

namespace stride::film {
namespace {

/// The window of the pelvis, moved into the frame where it would leave it.
cv::Rect window(const cv::Mat& image, double pelvis_x_px, double aspect) {
  const int width = std::min(image.cols, static_cast<int>(std::lround(image.rows * aspect)));
  const int left = static_cast<int>(std::lround(pelvis_x_px)) - width / 2;
  return {std::clamp(left, 0, image.cols - width), 0, width, image.rows};
}

}  // namespace

const cv::Mat& SourceStride::at(double wanted) const {
  const auto distance = [&](std::size_t i) {
    return std::abs(repeats ? std::remainder(phase[i] - wanted, 1.0) : phase[i] - wanted);
  };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < phase.size(); ++i)
    if (distance(i) < distance(nearest)) nearest = i;
  return frames[nearest];
}

SourceStride read_source_stride(const std::filesystem::path& file, double start_s, double period_s,
                                double slow_motion, const Trajectory* trajectory, double aspect) {
  require(std::isfinite(start_s) && start_s >= 0 && period_s > 0,
          "source stride: start {} s, period {} s: must be ≥ 0 and positive", start_s, period_s);
  SourceStride stride;
  video::Video video(file, slow_motion);
  video::VideoFrame frame;
  bool whole = false;
  // The pelvis of a frame that was not tracked is taken from the last one that was.
  double pelvis_x_px = video.info().width_px / 2.0;
  while (video.read(frame)) {
    const double phase = (frame.time_s - start_s) / period_s;
    if (trajectory)
      for (const TrajectoryFrame& tracked : trajectory->frames)
        if (tracked.frame == frame.index && tracked[BodyPart::pelvis].present())
          pelvis_x_px = tracked[BodyPart::pelvis].p_px.x();
    whole = phase >= 1;
    if (whole) break;
    if (phase < 0) continue;
    cv::Mat image = frame.image;
    if (trajectory) {
      image = image(window(image, pelvis_x_px, aspect)).clone();
      if (trajectory->direction == Facing::left) cv::flip(image, image, 1);
    }
    stride.phase.push_back(phase);
    stride.frames.push_back(image);
  }
  // The last frame may fall just short of the end of the stride.
  whole = whole || (stride.phase.size() > 1 &&
                    stride.phase.back() + 1.5 * (stride.phase[1] - stride.phase[0]) >= 1);
  require(whole && !stride.frames.empty(),
          "{}: ends at {:.3f} s, before the stride from {:.3f} s to {:.3f} s does", file.string(),
          frame.time_s, start_s, start_s + period_s);
  return stride;
}

cv::Mat side_by_side(const cv::Mat& left, const cv::Mat& right) {
  const double scale = static_cast<double>(right.rows) / left.rows;
  int width = static_cast<int>(std::lround(left.cols * scale));
  constexpr int kLine = 2;
  width += (width + kLine + right.cols) % 2;
  cv::Mat resized, both(right.rows, width + kLine + right.cols, CV_8UC3, cv::Scalar(40, 40, 40));
  cv::resize(left, resized, {width, right.rows}, 0, 0,
             scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
  resized.copyTo(both(cv::Rect(0, 0, width, right.rows)));
  right.copyTo(both(cv::Rect(width + kLine, 0, right.cols, right.rows)));
  return both;
}

}  // namespace stride::film
