#pragma once

#include "extract/skeleton/trajectory.h"

namespace stride::tracking {

/// Standard deviation of a detector's point of confidence 1 from frame to frame, each coordinate,
/// in leg lengths; it grows as the confidence falls. Measured: extract/pose/network_points.cpp.
inline constexpr double kDetectedNoise_legs = 0.0152;
inline constexpr double kHand_legs = 0.015;  // of a person's click
double detected_noise_legs(double confidence);

/// How far a detector's idea of a joint is from ours on the same place of every frame, in leg
/// lengths: standard deviation along the limb above it and across. Measured on our clips.
struct Convention {
  double along_legs = 0, across_legs = 0;
};
Convention convention(BodyPart part);

/// A detector's points with a person's clicks in place of them where there are any, and what the
/// clicks teach of the others: regression on the clicks' offsets, which are one offset of all
/// frames and both legs in the axes of the limb (the detector's convention), the detector's noise,
/// which hardly outlasts a frame, and the hand's. So a click on a point that is wrong by itself
/// moves no other, and the click's own noise is not spread. Both runners must have the same legs on
/// the same side. Frames of `clicks` that the detector does not have are added.
Trajectory corrected(const Trajectory& detected, const Trajectory& clicks);

}  // namespace stride::tracking
