#include "extract/tracking/picture_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kMostGlimpses = 16;
constexpr double kWidth_px = 640;  // of a glimpse, at most
constexpr double kMoves_px = 2;    // in it: what rests agrees with any background
constexpr int kFewest = 24;
constexpr double kLeastFollow = 0.3;  // of points on their limbs two thirds follow or more

/// Where other points would lie: the frame that they are of, and their places.
struct Remedy {
  std::string name;
  std::function<Vector2d(const Vector2d&)> moved = [](const Vector2d& p) { return p; };
  int frames_later = 0;
};

using FramesByNumber = std::map<int, const TrajectoryFrame*>;

FramesByNumber by_number(const Trajectory& points) {
  FramesByNumber frames;
  for (const TrajectoryFrame& frame : points.frames) frames[frame.frame] = &frame;
  return frames;
}

PictureCheck compared(const FramesByNumber& frames, const std::vector<Glimpse>& glimpses,
                      const Remedy& remedy) {
  int followed = 0;
  PictureCheck check;
  for (const Glimpse& glimpse : glimpses) {
    if (glimpse.second.empty()) continue;
    const auto a = frames.find(glimpse.frame - remedy.frames_later),
               b = frames.find(glimpse.frame - remedy.frames_later + 1);
    if (a == frames.end() || b == frames.end()) continue;
    std::vector<cv::Point2f> from, to, flow;
    const cv::Rect2f inside(0, 0, static_cast<float>(glimpse.first.cols - 1),
                            static_cast<float>(glimpse.first.rows - 1));
    for (const BodyPart part : kBodyParts) {
      const Point &p = (*a->second)[part], &q = (*b->second)[part];
      if (!p.present() || !q.present()) continue;
      const Vector2d before = glimpse.scale * remedy.moved(p.p_px),
                     after = glimpse.scale * remedy.moved(q.p_px);
      if ((after - before).norm() < kMoves_px) continue;
      ++check.compared;
      const cv::Point2f start(static_cast<float>(before.x()), static_cast<float>(before.y()));
      if (!inside.contains(start)) continue;
      from.push_back(start);
      to.emplace_back(static_cast<float>(after.x()), static_cast<float>(after.y()));
    }
    if (from.empty()) continue;
    std::vector<unsigned char> found;
    std::vector<float> error;
    cv::calcOpticalFlowPyrLK(glimpse.first, glimpse.second, from, flow, found, error, {15, 15}, 3);
    for (std::size_t i = 0; i < from.size(); ++i) {
      const double moved_px = cv::norm(to[i] - from[i]);
      followed += found[i] && cv::norm(flow[i] - to[i]) < std::max(1.5, 0.35 * moved_px);
    }
  }
  check.follow = check.compared > 0 ? static_cast<double>(followed) / check.compared : 0;
  return check;
}

std::vector<Remedy> remedies(const video::VideoInfo& info) {
  std::vector<Remedy> all;
  const double w = info.width_px, h = info.height_px;
  for (const double factor : {0.5, 2.0, 2.0 / 3, 1.5, 0.75, 4.0 / 3, 1.0 / 3, 3.0, 0.25, 4.0})
    all.push_back(
        {fmt::format("made on a picture of {:.0f} x {:.0f} px: --points-size {:.0f} {:.0f}",
                     w / factor, h / factor, w / factor, h / factor),
         [factor](const Vector2d& p) -> Vector2d { return factor * (p.array() + 0.5) - 0.5; }});
  all.push_back({fmt::format("their y grows upwards: --y-up {}", info.height_px),
                 [h](const Vector2d& p) { return Vector2d(p.x(), h - 1 - p.y()); }});
  all.push_back({"made on the picture turned by 180 degrees: turn them",
                 [=](const Vector2d& p) { return Vector2d(w - 1 - p.x(), h - 1 - p.y()); }});
  all.push_back({"made on the picture turned by 90 degrees: turn them",
                 [=](const Vector2d& p) { return Vector2d(w - 1 - p.y(), p.x()); }});
  all.push_back({"made on the picture turned by 270 degrees: turn them",
                 [=](const Vector2d& p) { return Vector2d(p.y(), h - 1 - p.x()); }});
  all.push_back({"made on the mirrored picture: mirror them",
                 [=](const Vector2d& p) { return Vector2d(w - 1 - p.x(), p.y()); }});
  if (info.stored_width_px > 0 && info.stored_width_px != info.width_px) {
    const double wider = w / info.stored_width_px;
    all.push_back(
        {fmt::format("made on the stored picture, whose pixels are not square: --points-size {} {}",
                     info.stored_width_px, info.height_px),
         [wider](const Vector2d& p) { return Vector2d(wider * (p.x() + 0.5) - 0.5, p.y()); }});
  }
  for (int k = 1; k <= 30; ++k)
    for (const int later : {k, -k})
      all.push_back({.name = fmt::format("of the frames {} {}: --first-frame {}", k,
                                         later > 0 ? "later" : "before", -later),
                     .frames_later = later});
  return all;
}

}  // namespace

Glimpses::Glimpses(const Trajectory& points) {
  std::vector<int> pairs;
  for (std::size_t i = 1; i < points.frames.size(); ++i)
    if (points.frames[i].frame == points.frames[i - 1].frame + 1)
      pairs.push_back(points.frames[i - 1].frame);
  const std::size_t count = std::min(kMostGlimpses, pairs.size());
  for (std::size_t k = 0; k < count; ++k)
    wanted_.push_back(pairs[(2 * k + 1) * pairs.size() / (2 * count)]);
}

void Glimpses::add(const video::VideoFrame& frame) {
  const auto is_wanted = [&](int first) { return std::ranges::binary_search(wanted_, first); };
  if (!is_wanted(frame.index) && !is_wanted(frame.index - 1)) return;
  const double scale = std::min(1.0, kWidth_px / std::max(frame.image.cols, frame.image.rows));
  cv::Mat gray;
  cv::cvtColor(frame.image, gray, cv::COLOR_BGR2GRAY);
  if (scale < 1) cv::resize(gray, gray, {}, scale, scale, cv::INTER_AREA);
  if (is_wanted(frame.index - 1) && !glimpses_.empty()) glimpses_.back().second = gray;
  if (is_wanted(frame.index)) glimpses_.push_back({frame.index, gray, {}, scale});
}

PictureCheck check_with_picture(const Trajectory& points, const std::vector<Glimpse>& glimpses,
                                const video::VideoInfo& info) {
  const FramesByNumber frames = by_number(points);
  PictureCheck check = compared(frames, glimpses, {});
  if (!is_beside_the_picture(check)) return check;
  double best = std::max(0.4, check.follow + 0.2);
  for (const Remedy& remedy : remedies(info)) {
    const PictureCheck other = compared(frames, glimpses, remedy);
    if (other.compared < kFewest || other.follow <= best) continue;
    best = other.follow;
    check.remedy = remedy.name;
  }
  return check;
}

PictureCheck follow_frames_later(const Trajectory& points, const std::vector<Glimpse>& glimpses,
                                 int frames_later) {
  Remedy later;
  later.frames_later = frames_later;
  return compared(by_number(points), glimpses, later);
}

bool is_beside_the_picture(const PictureCheck& check) {
  return check.compared >= kFewest && check.follow < kLeastFollow;
}

}  // namespace stride::tracking
