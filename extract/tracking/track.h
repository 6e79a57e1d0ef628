#pragma once

#include <array>
#include <string>

#include "extract/skeleton/keypoints.h"
#include "extract/skeleton/trajectory.h"
#include "extract/tracking/gaussian_process/gait_prior.h"
#include "extract/video/decoded_clip.h"

namespace stride::tracking {

struct TrackOptions {
  bool flow = true;         // follow the picture between marks; otherwise the prior alone
  bool keep_marks = false;  // go exactly through every mark instead of averaging their noise out
  const Trajectory* prior = nullptr;  // a prediction in pixels, as from the fit of a body model
};

struct TrackSummary {
  gaussian_process::GaitPrior prior;  // what was learned of the gait: period, noise of the marks, …
  int labelled_frames = 0;
  double inlier = 0;  // share of the unmarked points where the flow was believed
  std::array<double, kBodyPartCount> miss_px{};  // rms by which the flow missed the next mark; NaN
  std::string shortfall;                         // as Video::shortfall()
};

struct Tracked {
  Trajectory trajectory;
  TrackSummary summary;
};

/// Every part in every frame from the first mark to the last.
///
/// `marks` has the marked frames only. Confidence of a mark: 1 clicked (the flow starts from it),
/// 0.5 marked as hidden, any other a detector's (weighs less, and outliers are given up); a mark
/// without a place but with a confidence says that the part is absent. Throws Error if there are no
/// marks, no pelvis, or a mark beyond the last frame.
///
/// In the result a clicked point has confidence 1. Between clicks it is above 0.3 where the flow
/// was believed, the more the better it led back and agreed with the rest; at most 0.3, and the
/// less the less certain the prior is, where only the prior speaks.
Tracked track(const Trajectory& marks, const video::DecodedClip& clip,
              const TrackOptions& options = {});

/// The clicks inside the trim range as marks.
Trajectory marks_of(const Keypoints& keypoints);

/// "right" or "left": the way the runner faces, because knees bend forward; empty if no leg was
/// seen.
std::string facing(const Trajectory& points);

}  // namespace stride::tracking
