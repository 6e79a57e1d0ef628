#include "extract/annotation/points_on_video.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <string_view>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/statistics.h"
#include "extract/tracking/corrections.h"
#include "extract/tracking/left_out_frames.h"
#include "extract/tracking/leg_identity.h"
#include "extract/tracking/limb_lengths.h"
#include "extract/tracking/picture_check.h"

namespace stride::tracking {
namespace fs = std::filesystem;
namespace {

using Eigen::Vector2d;

template <typename... Args>
void warn(fmt::format_string<Args...> message, Args&&... args) {
  fmt::print(stderr, "warning: {}\n", fmt::format(message, std::forward<Args>(args)...));
}

Trajectory marks_of(const imports::Detections& detections) {
  Trajectory marks;
  for (const imports::ImportedFrame& imported : detections.frames) {
    TrajectoryFrame& frame = marks.frames.emplace_back();
    frame.frame = imported.frame;
    frame.points = imported.points;
  }
  return marks;
}

/// Of the frames of a detector's points: more have a limb of another length than usual where the
/// body is no person's.
constexpr double kMostBroken = 0.6;

/// A person's labels are sparse and correct; a detector's points are on most frames.
bool are_labels(const Trajectory& marks) {
  const auto n = static_cast<int>(marks.frames.size());
  return n < 2 || marks.frames.back().frame - marks.frames.front().frame >= 2 * (n - 1);
}

template <typename Visit>
void for_each_point(Trajectory& marks, Visit visit) {
  for (TrajectoryFrame& frame : marks.frames)
    for (Point& point : frame.points)
      if (point.present()) visit(point);
}

/// Pixel centres of a picture of one size on another one; a size of 1 means normalised coordinates.
double scaled(double at, int from_px, int to_px) {
  if (from_px == 1) return at * to_px - 0.5;
  return (at + 0.5) * to_px / from_px - 0.5;
}

/// From the size that the user or the file says to the video's.
void scale(const imports::Detections& detections, const imports::ImportOptions& said,
           const video::VideoInfo& info, Trajectory& marks) {
  std::string from;
  for (std::size_t i = 0; i < marks.frames.size(); ++i) {
    const imports::ImportedFrame& imported = detections.frames[i];
    const bool is_said = said.size_px.size() == 2;
    const int width = is_said ? said.size_px[0] : imported.width_px,
              height = is_said ? said.size_px[1] : imported.height_px;
    if (width <= 0 || height <= 0 || (width == info.width_px && height == info.height_px)) continue;
    const double aspect = static_cast<double>(width) * info.height_px / height / info.width_px;
    const bool is_stored = width == info.stored_width_px && height == info.height_px;
    const bool is_share = width == 1 && height == 1;
    require(is_said || is_stored || is_share || std::abs(aspect - 1) < 0.03,
            "{}: frame {}: the points were made on a picture of {} x {} px, the video is {} x {}: "
            "do they belong to another video?",
            detections.file, imported.frame, width, height, info.width_px, info.height_px);
    if (!is_share || is_said) from = fmt::format("{} x {}", width, height);
    for (Point& point : marks.frames[i].points)
      if (point.present())
        point.p_px = {scaled(point.p_px.x(), width, info.width_px),
                      scaled(point.p_px.y(), height, info.height_px)};
  }
  if (!from.empty())
    warn("the points were made on a picture of {} px and are scaled to the video's {} x {}", from,
         info.width_px, info.height_px);
}

/// Frames as the video counts them.
void renumber(const imports::Detections& detections, const imports::ImportOptions& said, int frames,
              Trajectory& marks) {
  const int last = marks.frames.back().frame;
  int first = said.first_frame.value_or(0);
  if (!said.first_frame && marks.frames.front().frame >= 1 && last == frames) {
    first = 1;
    warn(
        "the points' frames are taken to count from 1, because the last is {} and the video has "
        "{} (--first-frame 0 otherwise)",
        last, frames);
  }
  for (TrajectoryFrame& frame : marks.frames) frame.frame -= first;
  std::erase_if(marks.frames, [](const TrajectoryFrame& frame) { return frame.frame < 0; });
  require(!marks.frames.empty() && marks.frames.back().frame < frames,
          "{}: has points to frame {}, but the video has {} frames: do they belong to another "
          "video, or was this one trimmed? (--first-frame N: the number of its first frame)",
          detections.file, last, frames);
}

/// Counts frames that were left out of the file's numbers.
void renumber_after_dropouts(const fs::path& video, int frames, Trajectory& marks) {
  const std::vector<LeftOutFrames> left_out = left_out_frames(marks, video, frames);
  for (const LeftOutFrames& each : left_out)
    warn(
        "the points leap at frame {} and go from there where the picture goes {} frames later: the "
        "file does not count {} frames without points; taken so (write the true frame numbers, or "
        "empty rows, into the file)",
        each.frame, each.count, each.count);
  for (TrajectoryFrame& frame : marks.frames) {
    const int number = frame.frame;
    for (const LeftOutFrames& each : left_out)
      if (number >= each.frame) frame.frame += each.count;
  }
}

/// Points that all lie in one place are no body: refused of a network that always finds a whole
/// one, told of parts that somebody named. (Normalised coordinates are told elsewhere.)
void check_body(const imports::Detections& detections, const Trajectory& marks) {
  constexpr double kLeast_px = 4, kNormalised = 2;
  constexpr int kLeastPoints = 3;  // with fewer of a frame they say nothing of a body
  int most_points = 0;
  double largest_px = 0, farthest = 0;
  for (const TrajectoryFrame& frame : marks.frames) {
    Eigen::AlignedBox2d box;
    int points = 0;
    for (const Point& point : frame.points)
      if (point.present()) box.extend(point.p_px), ++points;
    most_points = std::max(most_points, points);
    if (points == 0) continue;
    largest_px = std::max(largest_px, box.diagonal().norm());
    farthest = std::max(farthest, box.max().maxCoeff());
  }
  if (most_points < kLeastPoints || largest_px > kLeast_px || farthest <= kNormalised) return;
  const std::string what = fmt::format(
      "{}: expected a person: the points of each frame lie within {:.1f} px of one another",
      detections.file, largest_px);
  constexpr std::array<std::string_view, 3> kWhole{"mediapipe", "ultralytics", "rtmpose"};
  require(std::ranges::find(kWhole, detections.format) == kWhole.end(), "{}", what);
  warn("{}", what);
}

/// Coordinates that are no pixels of this picture; a few points outside it are left out.
void check_places(const video::VideoInfo& info, Trajectory& marks) {
  constexpr double kFew = 0.1;
  int points = 0, outside = 0;
  double largest = 0;
  Vector2d farthest = Vector2d::Zero();
  const auto is_outside = [&](const Vector2d& p) {
    return p.x() < -0.5 || p.y() < -0.5 || p.x() > info.width_px - 0.5 ||
           p.y() > info.height_px - 0.5;
  };
  const Vector2d middle(0.5 * info.width_px, 0.5 * info.height_px);
  for_each_point(marks, [&](const Point& point) {
    ++points;
    largest = std::max(largest, point.p_px.lpNorm<Eigen::Infinity>());
    if (!is_outside(point.p_px)) return;
    ++outside;
    if ((point.p_px - middle).norm() > (farthest - middle).norm()) farthest = point.p_px;
  });
  if (points > 0 && largest <= 2) {
    warn(
        "all points lie between 0 and {:.2f}: normalised coordinates, not pixels; --points-size 1 "
        "1 takes them for parts of the picture",
        largest);
    return;
  }
  if (outside == 0) return;
  const bool few = outside <= kFew * points;
  warn("{} of {} points lie outside the picture of {} x {} px, as far as ({:.0f}, {:.0f}): {}",
       outside, points, info.width_px, info.height_px, farthest.x(), farthest.y(),
       few ? "left out"
           : "were they made on a picture of another size (--points-size), or with another origin "
             "or unit?");
  if (few)
    for_each_point(marks, [&](Point& point) {
      if (is_outside(point.p_px)) point = {};
    });
}

/// How far the knees are below the pelvis, px.
double knees_below_px(const Trajectory& marks) {
  std::vector<double> below;
  for (const TrajectoryFrame& frame : marks.frames)
    for (const BodyPart knee : {BodyPart::knee_r, BodyPart::knee_l})
      if (frame[knee].present() && frame[BodyPart::pelvis].present())
        below.push_back(frame[knee].p_px.y() - frame[BodyPart::pelvis].p_px.y());
  return below.empty() ? 0 : median(std::move(below));
}

void check_y_up(const imports::ImportOptions& said, const video::VideoInfo& info,
                const Trajectory& marks) {
  if (said.y_up_height_px == 0) return;
  require(said.y_up_height_px == info.height_px,
          "--y-up {}: must be the height of the video, {} px", said.y_up_height_px, info.height_px);
  require(knees_below_px(marks) >= 0,
          "--y-up {}: turns the points on their heads, the file's y grows downwards; leave it out",
          said.y_up_height_px);
}

/// Points of a picture that lies or stands on its head.
void check_posture(const Trajectory& marks) {
  Vector2d leg = Vector2d::Zero();
  for (const TrajectoryFrame& frame : marks.frames)
    for (const BodyPart ankle : {BodyPart::ankle_r, BodyPart::ankle_l})
      if (frame[ankle].present() && frame[BodyPart::pelvis].present())
        leg += frame[ankle].p_px - frame[BodyPart::pelvis].p_px;
  if (std::abs(leg.x()) > std::abs(leg.y()))
    warn("the legs lie level: were the points made on the picture turned by 90 degrees?");
  else if (leg.y() < 0)
    warn(
        "the points stand on their heads: were they made on the picture turned by 180 degrees, or "
        "does their y grow upwards (--y-up)?");
}

/// Points that may have been made on stored frames, whose pixels are not square.
void check_aspect(const imports::ImportOptions& said, const video::VideoInfo& info,
                  Trajectory& marks) {
  if (said.size_px.size() == 2 || info.stored_width_px >= info.width_px) return;
  double farthest = 0;
  for_each_point(marks, [&](const Point& p) { farthest = std::max(farthest, p.p_px.x()); });
  if (farthest < info.stored_width_px)
    warn(
        "the video's pixels are not square: it is stored {} px wide and shown {}; points made on "
        "the stored frames want --points-size {} {}",
        info.stored_width_px, info.width_px, info.stored_width_px, info.height_px);
}

/// Frames at either end of the video on which a detector found nobody.
void check_cover(int frames, const Trajectory& marks) {
  const int before = marks.frames.front().frame, after = frames - 1 - marks.frames.back().frame;
  const int many = std::max(5, frames / 20);
  if (after > many)
    warn("no points on the last {} of {} frames: are the points' frames numbered as the video's?",
         after, frames);
  if (before > many) warn("no points on the first {} of {} frames", before, frames);
}

void check_motion(const Trajectory& marks, const Glimpses& glimpses, const video::VideoInfo& info) {
  const PictureCheck check = check_with_picture(marks, glimpses.all(), info);
  if (!is_beside_the_picture(check)) return;
  warn("the points do not follow the picture: only {:.0f} % of them go where it goes; {}",
       100 * check.follow,
       check.remedy.empty() ? "do they lie beside the runner, or belong to another video?"
                            : fmt::format("{} of them would if {}", "most", check.remedy));
}

/// The middle of the hips of another layout of points is somewhere else.
void check_layout(const Trajectory& marks) {
  std::vector<double> off;
  for (const TrajectoryFrame& frame : marks.frames) {
    const Point &pelvis = frame[BodyPart::pelvis], &right = frame[BodyPart::hip_r],
                &left = frame[BodyPart::hip_l], &knee = frame[BodyPart::knee_r];
    if (!pelvis.present() || !right.present() || !left.present() || !knee.present()) continue;
    const Vector2d hips = 0.5 * (right.p_px + left.p_px);
    off.push_back((pelvis.p_px - hips).norm() / std::max((knee.p_px - hips).norm(), 1.0));
  }
  if (off.size() >= 3 && median(off) > 0.6)
    warn("the pelvis is not between the hips: another layout of points, as OpenPose's BODY_25B?");
}

Trajectory repaired(const Trajectory& marks) {
  const LegIdentity legs = repair_legs(marks);
  for (const LegSwap& swap : legs.swaps)
    fmt::print(stderr, "legs swapped on frames {}–{}: {}\n", swap.first_frame, swap.last_frame,
               swap.why);
  return legs.repaired;
}

}  // namespace

LabelledClip points_on(const fs::path& file, const imports::Detections& detections,
                       const PointsOnVideoOptions& options) {
  for (const std::string& warning : detections.warnings) warn("{}", warning);
  const std::string hash = sha256_of_file(file);
  require(detections.video_sha256.empty() || detections.video_sha256 == hash,
          "{}: belongs to another video ({}, by its hash); give that one, or take the line "
          "video_sha256 out",
          detections.file, detections.video);
  LabelledClip labelled{marks_of(detections), options.slow_motion};
  Trajectory& marks = labelled.marks;
  marks.video = file.filename().string();

  video::Video decoder(file, options.slow_motion);
  Glimpses glimpses(marks);
  std::vector<double> times_s;
  for (video::VideoFrame frame; decoder.read(frame);) {
    glimpses.add(frame);
    times_s.push_back(frame.time_s);
  }
  const video::VideoInfo& info = decoder.info();
  scale(detections, options.import, info, marks);
  check_y_up(options.import, info, marks);
  renumber(detections, options.import, static_cast<int>(times_s.size()), marks);
  check_places(info, marks);
  check_body(detections, marks);
  check_aspect(options.import, info, marks);
  check_posture(marks);
  check_layout(marks);
  const bool labels = are_labels(marks);
  const bool from_file = !detections.file.empty();  // a network numbers frames as the video does
  if (!labels && from_file) {
    renumber_after_dropouts(file, static_cast<int>(times_s.size()), marks);
    check_cover(static_cast<int>(times_s.size()), marks);
  }
  if (!labels) check_motion(marks, glimpses, info);
  for (TrajectoryFrame& frame : marks.frames)
    frame.time_s = times_s[static_cast<std::size_t>(frame.frame)];
  marks.video_sha256 = hash;
  marks.width_px = info.width_px;
  marks.height_px = info.height_px;
  if (options.repair_legs && !labels) marks = repaired(marks);
  if (!from_file && !labels) {
    const int broken = doubt_broken_limbs(marks, kDetectedNoise_legs);
    const auto frames = static_cast<int>(marks.frames.size());
    require(broken <= kMostBroken * frames,
            "{0}: what the pose network sees is no runner from the side: its thighs and shanks "
            "change their length on {1} of {2} frames; click instead: stride annotate {0}",
            file.string(), broken, frames);
  }
  marks.direction = facing(marks);
  marks.video = file.filename().string();
  return labelled;
}

}  // namespace stride::tracking
