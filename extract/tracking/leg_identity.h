#pragma once

#include <set>
#include <string>
#include <vector>

#include "extract/skeleton/trajectory.h"

namespace stride::tracking {

struct LegIdentityOptions {
  std::set<int> clicked_frames;  // a person said which leg is which: never overruled
};

/// Frames on which the legs were named the wrong way round.
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

/// Finds on which frames right and left are swapped (knee, ankle, toe and hip together; a foot that
/// hangs on the wrong knee is moved first, by the length of the shank) and names them right.
///
/// Over the whole clip the naming is chosen that is most likely (Viterbi): each joint goes where
/// its last two places send it, right and left follow the same motion half a stride apart, most
/// names that came in are right, and the leg nearer to the camera is seen better. A clip whose
/// names are all swapped cannot be told by motion; there the names that came in are kept.
///
/// Sparse points, as a person's clicks, are told apart by the stride alone, from 12 frames on.
///
/// `points` may have gaps and missing parts; parts relative to the pelvis, which is interpolated
/// where missing. Throws Error if no frame has a pelvis.
LegIdentity repair_legs(const Trajectory& points, const LegIdentityOptions& options = {});

/// Exchanges right and left of a frame.
void swap_legs(TrajectoryFrame& frame);

}  // namespace stride::tracking
