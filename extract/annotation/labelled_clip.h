#pragma once

#include <filesystem>

#include "extract/skeleton/keypoints.h"
#include "extract/tracking/track.h"

namespace stride::tracking {

/// The labelled points of a video.
struct LabelledClip {
  Trajectory marks;
  double slow_motion = 1;         // seconds of video per second of the runner
  std::string points = "clicks";  // whose they are: "clicks", "network", "mixed", "import"
};

/// The clicks on a video, including those that a killed `stride annotate` left in its journal.
/// `slow_motion` > 0 replaces what the clicks say. Throws Error naming the cure where there is no
/// such video, where it was not clicked, or where it is not the one that was clicked.
LabelledClip clicks_on(const std::filesystem::path& video,
                       const std::filesystem::path& keypoints_file, double slow_motion);

/// Throws Error, beginning with `file`, unless the clicks lie on a picture of this size, px.
void check_picture(const Keypoints& keypoints, int width_px, int height_px,
                   const std::filesystem::path& file);

/// Tracks the labelled points through their video, which is decoded once.
Tracked track(const std::filesystem::path& video, const LabelledClip& labelled,
              const TrackOptions& options = {}, const video::DecodeOptions& decode_options = {});

}  // namespace stride::tracking
