#include "extract/tracking/left_out_frames.h"

#include <algorithm>
#include <array>
#include <limits>

#include "extract/io/statistics.h"
#include "extract/tracking/leg_identity.h"
#include "extract/tracking/picture_check.h"
#include "extract/video/video.h"

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr double kLeap = 5;  // times the usual distance of a joint's two extrapolations
constexpr double kLeastLeap_legs = 0.04;
constexpr std::size_t kFewestJoints = 4;
constexpr int kFewestMissing = 3;  // frames without points at the end of the video
constexpr int kFewestCompared = 24;
constexpr double kLeastFollowed = 0.4, kGain = 0.2;  // of a number of frames that is believed
constexpr std::size_t kMostPictures = 40;            // of a piece between two leaps

using Four = std::array<const TrajectoryFrame*, 4>;  // neighbouring frames

/// How far apart a joint's path before and its path after the middle of four frames end there, px.
double apart_px(const Four& f, BodyPart before, BodyPart after) {
  const Vector2d a = 1.5 * (*f[1])[before].p_px - 0.5 * (*f[0])[before].p_px,
                 b = 1.5 * (*f[2])[after].p_px - 0.5 * (*f[3])[after].p_px;
  return (a - b).norm();
}

/// Every four frames in a row, by the third of them.
std::vector<Four> fours_of(const Trajectory& points) {
  std::vector<Four> fours;
  for (std::size_t i = 3; i < points.frames.size(); ++i)
    if (points.frames[i].frame == points.frames[i - 3].frame + 3)
      fours.push_back(
          {&points.frames[i - 3], &points.frames[i - 2], &points.frames[i - 1], &points.frames[i]});
  return fours;
}

double twice_shank_px(const Trajectory& points) {
  std::vector<double> legs;
  for (const TrajectoryFrame& frame : points.frames)
    for (const auto& [knee, ankle] : {std::pair(BodyPart::knee_r, BodyPart::ankle_r),
                                      std::pair(BodyPart::knee_l, BodyPart::ankle_l)})
      if (const double px = (frame[knee].p_px - frame[ankle].p_px).norm(); std::isfinite(px))
        legs.push_back(2 * px);
  return legs.empty() ? std::numeric_limits<double>::quiet_NaN() : median(std::move(legs));
}

/// The median over the joints of how far they leap in the middle of four frames, in units of what
/// is usual for each, and in px.
struct Leap {
  double times = 0, px = 0;
};
Leap leap(const Four& four, const std::array<double, kBodyPartCount>& usual_px, bool exchanged) {
  std::vector<double> times, px;
  for (const BodyPart part : kBodyParts) {
    const double apart = apart_px(four, part, exchanged ? mirrored(part) : part);
    if (!std::isfinite(apart) || !(usual_px[index(part)] > 0)) continue;
    times.push_back(apart / usual_px[index(part)]);
    px.push_back(apart);
  }
  if (times.size() < kFewestJoints) return {};
  return {median(std::move(times)), median(std::move(px))};
}

/// Pairs of neighbouring frames spread over part of a video.
std::vector<int> spread(int first, int last) {
  std::vector<int> frames;
  const int step = std::max(1, (last - first) / static_cast<int>(kMostPictures));
  for (int frame = first; frame < last; frame += step) frames.push_back(frame);
  return frames;
}

/// The points between two leaps.
struct Piece {
  Trajectory points;
  int first() const { return points.frames.front().frame; }
  int last() const { return points.frames.back().frame; }
};
std::vector<Piece> pieces_of(const Trajectory& points, const std::vector<int>& leaps) {
  std::vector<Piece> pieces(1);
  for (const TrajectoryFrame& frame : points.frames) {
    if (std::ranges::binary_search(leaps, frame.frame)) pieces.emplace_back();
    pieces.back().points.frames.push_back(frame);
  }
  return pieces;
}

}  // namespace

std::vector<int> leaps_of(const Trajectory& points) {
  const std::vector<Four> fours = fours_of(points);
  std::array<double, kBodyPartCount> usual_px{};
  for (const BodyPart part : kBodyParts) {
    std::vector<double> all;
    for (const Four& four : fours)
      if (const double apart = apart_px(four, part, part); std::isfinite(apart))
        all.push_back(apart);
    usual_px[index(part)] = all.empty() ? 0 : std::max(median(std::move(all)), 0.5);
  }
  const double least_px = kLeastLeap_legs * twice_shank_px(points);
  struct Found {
    int frame = 0;
    double px = 0;
  };
  std::vector<Found> found;
  for (const Four& four : fours) {
    const Leap as_is = leap(four, usual_px, false), exchanged = leap(four, usual_px, true);
    if (std::min(as_is.times, exchanged.times) <= kLeap ||
        std::min(as_is.px, exchanged.px) <= least_px)
      continue;
    // The fours beside a leap see half of it.
    if (found.empty() || four[2]->frame - found.back().frame > 2)
      found.push_back({four[2]->frame, as_is.px});
    else if (as_is.px > found.back().px)
      found.back() = {four[2]->frame, as_is.px};
  }
  std::vector<int> leaps;
  for (const Found& each : found) leaps.push_back(each.frame);
  return leaps;
}

std::vector<LeftOutFrames> left_out_frames(const Trajectory& points,
                                           const std::filesystem::path& video, int frames) {
  const int missing = frames - 1 - points.frames.back().frame;
  const std::vector<int> leaps = leaps_of(points);
  if (leaps.empty() || missing < kFewestMissing) return {};
  const std::vector<Piece> pieces = pieces_of(points, leaps);
  std::vector<Glimpses> glimpses;
  for (std::size_t i = 1; i < pieces.size(); ++i)
    glimpses.emplace_back(spread(pieces[i].first(), std::min(pieces[i].last() + missing, frames)));
  video::Video decoder(video);
  for (video::VideoFrame frame; decoder.read(frame);)
    for (Glimpses& each : glimpses) each.add(frame);

  std::vector<LeftOutFrames> left_out;
  int shift = 0;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const auto follow = [&](int later) {
      return follow_frames_later(pieces[i].points, glimpses[i - 1].all(), later);
    };
    const PictureCheck as_numbered = follow(shift);
    double best = std::max(kLeastFollowed, as_numbered.follow + kGain);
    int count = 0;
    for (int later = shift + 1; later <= missing; ++later) {
      const PictureCheck check = follow(later);
      if (check.compared < kFewestCompared || check.follow <= best) continue;
      best = check.follow;
      count = later - shift;
    }
    if (count == 0) continue;
    left_out.push_back({pieces[i].first(), count});
    shift += count;
  }
  return left_out;
}

}  // namespace stride::tracking
