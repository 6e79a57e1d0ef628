#pragma once

#include <array>
#include <string>

#include "extract/skeleton/keypoints.h"
#include "extract/skeleton/trajectory.h"
#include "extract/tracking/gaussian_process/gait_prior.h"
#include "extract/video/decoded_clip.h"

namespace stride::tracking {

struct TrackOptions {
  bool flow = true;         // use optical flow between labelled points; otherwise the prior alone
  bool keep_marks = false;  // interpolate the labelled points instead of averaging their noise
  const Trajectory* prior = nullptr;  // a prediction in pixels, as from the fit of a body model
};

struct TrackSummary {
  gaussian_process::GaitPrior prior;  // what was learned of the gait: period, noise of the marks, …
  int labelled_frames = 0;
  double inlier = 0;  // share of the other points where the flow was an inlier
  std::array<double, kBodyPartCount> miss_px{};  // rms error of the flow; NaN if unknown
  std::string shortfall;                         // as Video::shortfall()
};

struct Tracked {
  Trajectory trajectory;
  TrackSummary summary;
};

/// Tracks every part in every frame from the first labelled frame to the last.
///
/// `marks` has the labelled frames only. Where a point is not clicked it has less weight, the less
/// the lower its confidence, and outliers are rejected. Throws Error if there are no points, no
/// pelvis, or a point beyond the last frame.
///
/// Confidence of the result: 1 for a clicked point; above kPredictedConfidence where the flow was
/// an inlier, increasing with its forward–backward consistency and its agreement with the rest; at
/// most that where only the prior speaks, decreasing with its uncertainty.
Tracked track(const Trajectory& marks, const video::DecodedClip& clip,
              const TrackOptions& options = {});

/// The clicks inside the trim range.
Trajectory marks_of(const Keypoints& keypoints);

/// The direction in which the runner faces, because knees bend forward; nothing if no leg was seen.
std::optional<Facing> facing(const Trajectory& points);

}  // namespace stride::tracking
