#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "calibrate/runner/calibrated.h"

namespace stride {

/// A part of the stride, or of a movement that does not repeat: the clip's samples in it.
struct PhaseBin {
  int count = 0;
  double phase = 0;                                          // their mean
  std::array<double, kCoordinateNames.size()> mean{}, sd{};  // of their coordinates
};

/// Which of so many equal parts a phase in [0, 1] is in.
std::size_t phase_bin(double phase, int bins);

/// A clip averaged over its strides in so many equal parts of the phase. `unit`: what a rad (and a
/// metre) is in the unit of the result.
std::vector<PhaseBin> phase_bins(const CalibratedTrajectory& clip, int bins, double unit = 1);

}  // namespace stride
