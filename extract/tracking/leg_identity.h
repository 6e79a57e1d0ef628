#pragma once

#include <set>
#include <string>
#include <vector>

#include "extract/skeleton/trajectory.h"

namespace stride::tracking {

struct LegIdentityOptions {
  std::set<int> clicked_frames;  // a person labelled the legs: never overruled
};

/// An interval of frames with swapped legs.
struct LegSwap {
  int first_frame = 0, last_frame = 0;  // both included
  double evidence = 0;                  // log likelihood ratio for the swap; above 0
  std::string why;                      // for the user
};

struct LegIdentity {
  Trajectory repaired;
  std::vector<LegSwap> swaps;  // in time order
  double period_s = 0;         // of the stride that the repair found; 0: too short to tell
};

/// Finds the frames on which right and left are swapped (knee, ankle, toe and hip together) and
/// swaps them back. Feet on the wrong knee are moved first, by the length of the shank.
///
/// Chooses the most likely labelling over the whole clip (Viterbi): each joint continues its motion
/// of the last two frames, right and left follow the same motion half a stride apart, most input
/// labels are right, and the leg nearer to the camera is detected better. A clip whose labels are
/// all swapped cannot be recognised by motion; its labels are kept.
///
/// Sparse points such as clicks are judged by the stride alone, from 12 frames on.
///
/// `points` may have gaps and missing parts. Parts are taken relative to the pelvis, which is
/// interpolated where missing. Throws Error if no frame has a pelvis.
LegIdentity repair_legs(const Trajectory& points, const LegIdentityOptions& options = {});

/// Exchanges right and left of a frame.
void swap_legs(TrajectoryFrame& frame);

}  // namespace stride::tracking
