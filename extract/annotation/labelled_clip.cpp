#include "extract/annotation/labelled_clip.h"

#include "extract/annotation/journal.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/tracking/leg_identity.h"

namespace stride::tracking {
namespace fs = std::filesystem;
namespace {

Trajectory marks_of(const imports::Detections& detections, const video::VideoTimes& times) {
  Trajectory marks;
  for (const imports::ImportedFrame& imported : detections.frames) {
    TrajectoryFrame& frame = marks.frames.emplace_back();
    frame.frame = imported.frame;
    frame.points = imported.points;
    if (imported.frame < static_cast<int>(times.times_s.size()))
      frame.time_s = times.times_s[static_cast<std::size_t>(imported.frame)];
  }
  return marks;
}

/// A person's labels are sparse and correct; a detector's points are on most frames.
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

LabelledClip clicks_on(const fs::path& video, const fs::path& keypoints_file, double slow_motion) {
  require(fs::exists(video), "{}: no such video", video.string());
  annotation::fold_left_over_journal(keypoints_file);
  require(fs::exists(keypoints_file),
          "{}: no such file; click points with 'stride annotate {}', or import them with 'stride "
          "track --import'",
          keypoints_file.string(), video.string());
  Keypoints keypoints = load_keypoints(keypoints_file);
  check_belongs_to(keypoints, video);
  if (slow_motion > 0) keypoints.slow_motion = slow_motion;
  LabelledClip labelled{marks_of(keypoints), keypoints.slow_motion};
  labelled.marks.video = video.filename().string();
  return labelled;
}

LabelledClip points_on(const fs::path& video, const imports::Detections& detections,
                       const video::VideoTimes& times, double slow_motion,
                       bool with_legs_repaired) {
  LabelledClip labelled{marks_of(detections, times), slow_motion};
  labelled.marks.video_sha256 = sha256_of_file(video);
  labelled.marks.width_px = times.info.width_px;
  labelled.marks.height_px = times.info.height_px;
  if (with_legs_repaired && !are_labels(labelled.marks)) labelled.marks = repaired(labelled.marks);
  labelled.marks.direction = facing(labelled.marks);
  labelled.marks.video = video.filename().string();
  return labelled;
}

Tracked track(const fs::path& video, const LabelledClip& labelled, const TrackOptions& options,
              const video::DecodeOptions& decode_options) {
  video::Video frames(video, labelled.slow_motion);
  video::DecodedClip clip = video::decode_clip(
      labelled.marks, [&](video::VideoFrame& frame) { return frames.read(frame); }, decode_options);
  clip.shortfall = frames.shortfall();
  return track(labelled.marks, clip, options);
}

}  // namespace stride::tracking
