#pragma once

#include <string_view>

#include "calibrate/runner/calibrated.h"
#include "extract/skeleton/units.h"
#include "shaping/potential.h"

namespace stride {

struct KeyframeOptions {
  int count = kKeyframesPerStride;  // of what does not repeat twice as many
  std::string foot = "ankle";       // or "toe"
  /// Makes the left leg the mirror image of the right one, half a stride later or at the same time,
  /// as learning from mirrored experience requires; false keeps the runner's asymmetry. Without
  /// effect where the movement leaves the legs free.
  bool symmetric = true;
  InverseDistance function = InverseDistance::pf3;
  PotentialIndex index = PotentialIndex::time;
  double epsilon_m = 0.05;
  double weight = 1;
};

/// The pose of a sample. `foot` is "ankle" or "toe".
Pose pose_of(const CalibratedSample& sample, std::string_view foot);

/// The mean stride of a run as equally spaced keyframes, from a Fourier series fitted to all
/// samples by phase; what does not repeat from its beginning to its end. Throws Error naming
/// `origin` if the samples do not cover a whole stride, or not beginning and end.
Potential make_potential(const CalibratedTrajectory& run, const KeyframeOptions& options,
                         const std::string& origin);

}  // namespace stride
