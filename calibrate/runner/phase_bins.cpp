#include "calibrate/runner/phase_bins.h"

#include <algorithm>
#include <cmath>

namespace stride {

std::size_t phase_bin(double phase, int bins) {
  return static_cast<std::size_t>(std::clamp(static_cast<int>(phase * bins), 0, bins - 1));
}

std::vector<PhaseBin> phase_bins(const CalibratedTrajectory& clip, int bins, double unit) {
  std::vector<PhaseBin> all(static_cast<std::size_t>(bins));
  for (const CalibratedSample& sample : clip.samples) {  // sums first
    PhaseBin& bin = all[phase_bin(sample.phase, bins)];
    ++bin.count;
    bin.phase += sample.phase;
    for (std::size_t k = 0; k < bin.mean.size(); ++k) {
      const double value = unit * sample.coordinates[k];
      bin.mean[k] += value;
      bin.sd[k] += value * value;
    }
  }
  for (PhaseBin& bin : all) {
    if (bin.count == 0) continue;
    bin.phase /= bin.count;
    for (std::size_t k = 0; k < bin.mean.size(); ++k) {
      const double mean = bin.mean[k] /= bin.count;
      bin.sd[k] = std::sqrt(std::max(0.0, bin.sd[k] / bin.count - mean * mean));
    }
  }
  return all;
}

}  // namespace stride
