#pragma once

#include <string_view>

#include "calibrate/runner/calibrated.h"
#include "shaping/potential.h"

namespace stride {

struct KeyframeOptions {
  int count = 8;               // a stride: the paper's four a half step
  std::string foot = "ankle";  // or "toe"
  /// Makes the left leg the right one's mirror image half a stride later, as learning from mirrored
  /// experience needs it; false keeps the runner's own asymmetry.
  bool symmetric = true;
  InverseDistance function = InverseDistance::pf3;
  PotentialIndex index = PotentialIndex::time;
  double epsilon_m = 0.05;
  double weight = 1;
};

/// What the potential compares, of a runner at one moment. `foot` is "ankle" or "toe".
Pose pose_of(const CalibratedSample& sample, std::string_view foot);

/// The mean stride of a run as equally spaced keyframes: a Fourier series through all its samples,
/// by phase. Throws Error naming `origin` if they do not cover a whole stride.
Potential make_potential(const CalibratedTrajectory& run, const KeyframeOptions& options,
                         const std::string& origin);

}  // namespace stride
