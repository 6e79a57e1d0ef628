#include "extract/video/decoded_clip.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "extract/io/statistics.h"

namespace stride::video {
namespace {

using Eigen::Vector2d;

/// A box around the pelvis, interpolated between labelled frames.
class RunnerBox {
 public:
  explicit RunnerBox(const Trajectory& marks) {
    for (const TrajectoryFrame& frame : marks.frames) {
      const Point& pelvis = frame[BodyPart::pelvis];
      if (!pelvis.present()) continue;
      pelvis_.push_back({frame.frame, pelvis.p_px});
      for (const BodyPart part : kBodyParts)
        if (frame[part].present()) {
          low_ = low_.cwiseMin(frame[part].p_px - pelvis.p_px);
          high_ = high_.cwiseMax(frame[part].p_px - pelvis.p_px);
        }
    }
  }

  /// The extent of all labelled parts, plus a margin in each direction.
  cv::Rect at(int frame, const Vector2d& farther_low, const Vector2d& farther_high) const {
    if (pelvis_.empty()) return {};
    const Vector2d low = pelvis_at(frame) + low_ - farther_low,
                   size = high_ - low_ + farther_low + farther_high;
    return {static_cast<int>(low.x()), static_cast<int>(low.y()), static_cast<int>(size.x()),
            static_cast<int>(size.y())};
  }

 private:
  struct Place {
    int frame;
    Vector2d p_px;
  };

  Vector2d pelvis_at(int frame) const {
    const auto after = std::ranges::lower_bound(pelvis_, frame, {}, &Place::frame);
    if (after == pelvis_.begin()) return after->p_px;
    const Place& before = *(after - 1);
    if (after == pelvis_.end()) return before.p_px;
    const double share = static_cast<double>(frame - before.frame) / (after->frame - before.frame);
    return (1 - share) * before.p_px + share * after->p_px;
  }

  std::vector<Place> pelvis_;
  Vector2d low_ = Vector2d::Zero(), high_ = Vector2d::Zero();
};

/// JPEG of high quality takes a sixth.
void pack(RunnerCrop& crop) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", crop.gray, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
  crop.packed = cv::Mat(bytes, true).reshape(1, 1);
  crop.gray.release();
}

/// The box moved inside the frame: Lucas–Kanade needs crops of one size.
RunnerCrop cropped(const cv::Mat& bgr, cv::Rect box) {
  box.width = std::min(box.width, bgr.cols);
  box.height = std::min(box.height, bgr.rows);
  box.x = std::clamp(box.x, 0, bgr.cols - box.width);
  box.y = std::clamp(box.y, 0, bgr.rows - box.height);
  if (box.empty()) box = cv::Rect(0, 0, bgr.cols, bgr.rows);
  RunnerCrop crop;
  cv::cvtColor(bgr(box), crop.gray, cv::COLOR_BGR2GRAY);
  crop.origin = box.tl();
  return crop;
}

}  // namespace

cv::Mat RunnerCrop::image() const {
  return packed.empty() ? gray : cv::imdecode(packed, cv::IMREAD_GRAYSCALE);
}

double body_size_px(const Trajectory& marks) {
  std::vector<double> sizes;
  for (const TrajectoryFrame& frame : marks.frames) {
    double size = 0;
    for (const BodyPart part : kBodyParts)
      if (frame[part].present() && frame[BodyPart::pelvis].present())
        size = std::max(size, (frame[part].p_px - frame[BodyPart::pelvis].p_px).norm());
    if (size > 0) sizes.push_back(size);
  }
  return sizes.empty() ? 90 : median(std::move(sizes));
}

DecodedClip decode_clip(const Trajectory& marks, const FrameSource& frames,
                        const DecodeOptions& options) {
  DecodedClip clip;
  const RunnerBox runner(marks);
  const double size_px = body_size_px(marks);
  const int first = marks.frames.empty() ? 0 : marks.frames.front().frame,
            last = marks.frames.empty() ? -1 : marks.frames.back().frame;
  clip.first_frame = first;
  double held_bytes = 0;
  CameraTracker camera({.most_features = 48});  // enough for the displacement; half the time of 80
  for (VideoFrame frame; frames(frame);) {
    clip.times_s.push_back(frame.time_s);
    if (frame.index < first || frame.index > last) continue;
    if (options.crops) {
      const Vector2d margin = Vector2d::Constant(0.4 * size_px + 16);
      RunnerCrop& crop =
          clip.crops.emplace_back(cropped(frame.image, runner.at(frame.index, margin, margin)));
      held_bytes += static_cast<double>(crop.gray.total());
      if (held_bytes > options.most_bytes) pack(crop);
    }
    if (options.camera) {  // excludes arms and head too
      const cv::Rect box =
          runner.at(frame.index, Vector2d(0.4, 1.1) * size_px, Vector2d(0.4, 0.3) * size_px);
      clip.camera.push_back(camera.add(frame.image, box));
    }
    if (options.progress) options.progress(frame.index, last);
  }
  return clip;
}

}  // namespace stride::video
