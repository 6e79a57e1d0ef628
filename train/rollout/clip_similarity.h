#pragma once

#include "train/rollout/rollout.h"

namespace stride::rollout {

/// How much a runner runs like a clip: its hips, knees and ankles against the clip's at the same
/// share of a stride, which begins with the strike of the right foot. NaN where there is no stride.
struct ClipSimilarity {
  double angle_rms_deg = 0;  // of the difference to the clip's mean stride
  double inside_share = 0;   // of angles within the clip's band
};

/// The band around the clip's mean stride: two of its standard deviations over the strides, and at
/// least so much.
inline constexpr double kNarrowestBand_deg = 10;

/// Over the whole strides of the rollout after `from_s`.
ClipSimilarity similarity(const Rollout& rollout, const CalibratedTrajectory& clip,
                          const osim::Model& model, double from_s = 2);

}  // namespace stride::rollout
