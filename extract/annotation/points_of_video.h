#pragma once

#include <filesystem>
#include <functional>

#include "extract/annotation/labelled_clip.h"

namespace stride::tracking {

struct PointsOptions {
  std::filesystem::path keypoints;  // clicks; empty: NAME.keypoints.json beside the video
  double slow_motion = 0;  // seconds of video a second of the runner; 0: as the clicks say, or 1
  bool network = false;    // the pose network also where there are clicks, which then correct it
  std::filesystem::path landmarks;  // the network's .tflite; empty: the installed one
  int person = 0;                   // of those whom the network follows, as in pose::NetworkOptions
  bool repair_legs = true;          // of the network's points
  std::function<void(int done, int of)> progress;  // of the network
};

/// The clicks on a video or, where there are none, what the pose network sees without any;
/// `points` says which. Clicks always win: where both are wanted, the network's points are
/// corrected by them. What the network saw is told on stderr. Throws Error with both cures where
/// there are neither clicks nor a network, and as clicks_on() and network_points() do.
LabelledClip points_of_video(const std::filesystem::path& video, const PointsOptions& options);

/// Whether points_of_video() asks the network: there are no clicks, or they correct it.
bool is_seen_by_network(const std::filesystem::path& video, const PointsOptions& options);

/// The pose network's points on a video, without a click.
LabelledClip points_of_network(const std::filesystem::path& video, const PointsOptions& options);

/// The network's points, corrected by clicks: everywhere by what the clicks teach, at the clicks by
/// the clicks themselves.
LabelledClip mixed(LabelledClip network, const LabelledClip& clicks);

}  // namespace stride::tracking
