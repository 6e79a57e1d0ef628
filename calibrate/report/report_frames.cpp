#include "calibrate/report/report_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <span>

#include "calibrate/fitted.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/video/video.h"

namespace stride::report {
namespace {

const cv::Scalar kRight(34, 59, 214), kLeft(200, 110, 20), kMark(255, 255, 255), kEdge(30, 30, 30);
constexpr int kSubpixelBits = 4;

/// One tile: a window of the frame around the pelvis, and its transform.
class Tile {
 public:
  Tile(const cv::Mat& frame, const Eigen::Vector2d& middle, double scale, cv::Mat tile)
      : middle_(middle), scale_(scale), tile_(std::move(tile)) {
    const cv::Matx23d map(scale, 0, 0.5 * tile_.cols - scale * middle.x(), 0, scale,
                          0.5 * tile_.rows - scale * middle.y());
    cv::warpAffine(frame, tile_, map, tile_.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT,
                   cv::Scalar(225, 225, 225));
  }

  void bone(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const cv::Scalar& colour) {
    cv::line(tile_, at(a), at(b), kEdge, 5, cv::LINE_AA, kSubpixelBits);
    cv::line(tile_, at(a), at(b), colour, 3, cv::LINE_AA, kSubpixelBits);
  }
  void mark(const Eigen::Vector2d& p) {
    cv::circle(tile_, at(p), 5 << kSubpixelBits, kEdge, 3, cv::LINE_AA, kSubpixelBits);
    cv::circle(tile_, at(p), 5 << kSubpixelBits, kMark, 1, cv::LINE_AA, kSubpixelBits);
  }

 private:
  cv::Point at(const Eigen::Vector2d& p_px) const {
    const Eigen::Vector2d p =
        (scale_ * (p_px - middle_) + 0.5 * Eigen::Vector2d(tile_.cols, tile_.rows)) *
        (1 << kSubpixelBits);
    return {static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))};
  }
  Eigen::Vector2d middle_;
  double scale_;
  cv::Mat tile_;
};

void draw_runner(const TrajectoryFrame& fitted, const TrajectoryFrame& labelled, bool to_left,
                 Tile& tile) {
  const auto lines = [&](std::span<const Bone> bones, const cv::Scalar& colour) {
    for (const auto& [from, to] : bones)
      if (fitted[from].present() && fitted[to].present())
        tile.bone(fitted[from].p_px, fitted[to].p_px, colour);
  };
  const auto right = [&] { lines(kLegBones<Side::right>, kRight), lines({&kSoles[0], 1}, kRight); };
  const auto left = [&] { lines(kLegBones<Side::left>, kLeft), lines({&kSoles[1], 1}, kLeft); };
  // The right leg of a runner who faces right is in front.
  if (to_left)
    right(), left();
  else
    left(), right();
  for (const Point& point : labelled.points)
    if (point.present()) tile.mark(point.p_px);
}

}  // namespace

std::vector<int> keyframes_of_stride(const Calibration& c) {
  std::vector<int> nearest(kReportKeyframes);
  const double* cadence = c.fit.runner.cadence.data();
  for (int k = 0; k < kReportKeyframes; ++k) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < c.observations.u_s.size(); ++i) {
      const double u = c.observations.u_s[i];
      const double off =
          phase_at(cadence, u) - c.gait.foot_strike - static_cast<double>(k) / kReportKeyframes;
      const double cost = std::abs(off - std::round(off)) + 0.005 * std::abs(u);
      if (cost < least) least = cost, nearest[static_cast<std::size_t>(k)] = static_cast<int>(i);
    }
  }
  return nearest;
}

std::vector<int> keyframes_of_passage(const Trajectory& trajectory) {
  const std::vector<TrajectoryFrame>& frames = trajectory.frames;
  const double first_s = frames.front().time_s, last_s = frames.back().time_s;
  std::vector<int> nearest;
  for (int k = 0; k < kReportKeyframes; ++k) {
    const double at_s = std::lerp(first_s, last_s, static_cast<double>(k) / (kReportKeyframes - 1));
    const auto found = std::ranges::min_element(
        frames, {}, [&](const TrajectoryFrame& frame) { return std::abs(frame.time_s - at_s); });
    nearest.push_back(static_cast<int>(found - frames.begin()));
  }
  return nearest;
}

std::filesystem::path video_in(const std::filesystem::path& folder, const Trajectory& trajectory) {
  if (trajectory.video.empty()) return {};
  const auto file = folder / std::filesystem::path(trajectory.video).filename();
  if (!std::filesystem::exists(file)) return {};
  return sha256_of_file(file) == trajectory.video_sha256 ? file : std::filesystem::path();
}

std::string keyframe_strip(const std::filesystem::path& video, const Trajectory& trajectory,
                           const SagittalModel& model, const Calibration& c,
                           const std::vector<int>& shown, int width_px, int height_px) {
  constexpr double kShown = 2.5;  // legs from top to bottom
  constexpr int kGap = 4;
  std::multimap<int, int> by_frame;  // number of the frame in the video → keyframe
  for (int k = 0; k < kReportKeyframes; ++k)
    by_frame.emplace(
        trajectory.frames[static_cast<std::size_t>(shown[static_cast<std::size_t>(k)])].frame, k);

  const Trajectory fitted = fitted_points(trajectory, model, c);
  cv::Mat strip(height_px, width_px, CV_8UC3, cv::Scalar(255, 255, 255));
  const int tile_px = (width_px + kGap) / kReportKeyframes - kGap;
  video::Video decoder(video);
  video::VideoFrame frame;
  while (!by_frame.empty()) {
    require(decoder.read(frame), "{}: frame {} cannot be read", video.string(),
            by_frame.begin()->first);
    for (auto [it, end] = by_frame.equal_range(frame.index); it != end; it = by_frame.erase(it)) {
      const int k = it->second;
      const auto i = static_cast<std::size_t>(shown[static_cast<std::size_t>(k)]);
      const Eigen::Vector2d pelvis =
          fit::image_px(trajectory, c.observations.to_left,
                        (c.aperiodic ? c.aperiodic->fit.passage.pelvis_px : c.fit.pelvis_px)[i]);
      const double leg = c.aperiodic ? c.aperiodic->fit.passage.leg_px() : leg_px(c.fit.runner);
      Tile tile(frame.image, pelvis, height_px / (kShown * leg),
                strip(cv::Rect(k * (tile_px + kGap), 0, tile_px, height_px)));
      draw_runner(fitted.frames[i], trajectory.frames[i], c.observations.to_left, tile);
    }
  }
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", strip, bytes, {cv::IMWRITE_JPEG_QUALITY, 82});
  return {bytes.begin(), bytes.end()};
}

}  // namespace stride::report
