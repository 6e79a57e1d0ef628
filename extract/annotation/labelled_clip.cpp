#include "extract/annotation/labelled_clip.h"

#include "extract/annotation/journal.h"
#include "extract/io/error.h"
#include "extract/video/video.h"

namespace stride::tracking {
namespace fs = std::filesystem;

void check_picture(const Keypoints& keypoints, int width_px, int height_px, const fs::path& file) {
  require(keypoints.width_px == width_px && keypoints.height_px == height_px,
          "{}: the clicks lie on a picture of {} x {} px, the video is {} x {}: was its frame "
          "turned, scaled or cropped since?",
          file.string(), keypoints.width_px, keypoints.height_px, width_px, height_px);
}

LabelledClip clicks_on(const fs::path& video, const fs::path& keypoints_file, double slow_motion) {
  video::require_video_file(video);
  annotation::fold_left_over_journal(keypoints_file);
  require(fs::exists(keypoints_file),
          "{}: no such file; click points with 'stride annotate {}', or import them with 'stride "
          "track --import'",
          keypoints_file.string(), video.string());
  Keypoints keypoints = load_keypoints(keypoints_file);
  check_belongs_to(keypoints, video);
  const video::VideoInfo info = video::Video(video).info();
  check_picture(keypoints, info.width_px, info.height_px, keypoints_file);
  if (slow_motion > 0) keypoints.slow_motion = slow_motion;
  LabelledClip labelled{marks_of(keypoints), keypoints.slow_motion};
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
