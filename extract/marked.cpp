#include "extract/marked.h"

#include "extract/annotation/journal.h"
#include "extract/error.h"
#include "extract/file.h"
#include "extract/leg_identity.h"

namespace stride {
namespace fs = std::filesystem;
namespace {

Trajectory marks_of(const Detections& detections, const VideoTimes& times) {
  Trajectory marks;
  for (const ImportedFrame& imported : detections.frames) {
    TrajectoryFrame& frame = marks.frames.emplace_back();
    frame.frame = imported.frame;
    frame.points = imported.points;
    if (imported.frame < static_cast<int>(times.times_s.size()))
      frame.time_s = times.times_s[static_cast<std::size_t>(imported.frame)];
  }
  return marks;
}

/// Labels of a person are far apart and right; a detector's points are on most frames.
bool are_labels(const Trajectory& marks) {
  const auto n = static_cast<int>(marks.frames.size());
  return n < 2 || marks.frames.back().frame - marks.frames.front().frame >= 2 * (n - 1);
}

Trajectory repaired(const Trajectory& marks) {
  const LegIdentity legs = repair_legs(marks);
  for (const LegSwap& swap : legs.swaps)
    fmt::print(stderr, "legs swapped on frames {}–{}: {}\n", swap.first_frame, swap.last_frame,
               swap.why);
  return legs.repaired;
}

}  // namespace

Marked clicks_on(const fs::path& video, const fs::path& keypoints_file, double slow_motion) {
  require(fs::exists(video), "{}: no such video", video.string());
  fold_left_over_journal(keypoints_file);
  require(fs::exists(keypoints_file),
          "{}: no such file; click points with 'stride annotate {}', or import them with 'stride "
          "track --import'",
          keypoints_file.string(), video.string());
  Keypoints keypoints = load_keypoints(keypoints_file);
  check_belongs_to(keypoints, video);
  if (slow_motion > 0) keypoints.slow_motion = slow_motion;
  Marked marked{marks_of(keypoints), keypoints.slow_motion};
  marked.marks.video = video.filename().string();
  return marked;
}

Marked points_on(const fs::path& video, const Detections& detections, const VideoTimes& times,
                 double slow_motion, bool with_legs_repaired) {
  Marked marked{marks_of(detections, times), slow_motion};
  marked.marks.video_sha256 = sha256_of_file(video);
  marked.marks.width_px = times.info.width_px;
  marked.marks.height_px = times.info.height_px;
  if (with_legs_repaired && !are_labels(marked.marks)) marked.marks = repaired(marked.marks);
  marked.marks.direction = facing(marked.marks);
  marked.marks.video = video.filename().string();
  return marked;
}

Tracked track(const fs::path& video, const Marked& marked, const TrackOptions& options,
              const WatchOptions& watch_options) {
  Video frames(video, marked.slow_motion);
  Footage footage = watch(
      marked.marks, [&](VideoFrame& frame) { return frames.read(frame); }, watch_options);
  footage.shortfall = frames.shortfall();
  return track(marked.marks, footage, options);
}

}  // namespace stride
