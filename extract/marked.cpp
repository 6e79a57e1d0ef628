#include "extract/marked.h"

#include "extract/annotation/journal.h"
#include "extract/error.h"

namespace stride {
namespace fs = std::filesystem;

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

Tracked track(const fs::path& video, const Marked& marked, const TrackOptions& options,
              const WatchOptions& watch_options) {
  Video frames(video, marked.slow_motion);
  Footage footage = watch(
      marked.marks, [&](VideoFrame& frame) { return frames.read(frame); }, watch_options);
  footage.shortfall = frames.shortfall();
  return track(marked.marks, footage, options);
}

}  // namespace stride
