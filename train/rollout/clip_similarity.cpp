#include "train/rollout/clip_similarity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibrate/runner/phase_bins.h"
#include "extract/skeleton/units.h"
#include "train/rollout/gait_summary.h"

namespace stride::rollout {
namespace {

constexpr int kBins = 40;               // of a stride
constexpr std::size_t kFirstAngle = 3;  // of kCoordinateNames: hip_flexion_r
constexpr double kDeg = 1 / kDegree;    // of a rad

}  // namespace

ClipSimilarity similarity(const Rollout& rollout, const CalibratedTrajectory& clip,
                          const osim::Model& model, double from_s) {
  std::vector<double> strikes;  // of the right foot
  for (const FootContact& contact : foot_contacts(rollout, model))
    if (contact.side == 0 && contact.start_s >= from_s) strikes.push_back(contact.start_s);
  const std::vector<PhaseBin> bins = phase_bins(clip, kBins, kDeg);
  double squares = 0, inside = 0, count = 0;
  for (const RolloutFrame& frame : rollout.frames) {
    const auto next = std::ranges::upper_bound(strikes, frame.state.time_s);
    if (next == strikes.begin() || next == strikes.end()) continue;
    const double phase = (frame.state.time_s - *(next - 1)) / (*next - *(next - 1));
    const PhaseBin& bin = bins[phase_bin(phase, kBins)];
    if (bin.count == 0) continue;
    for (std::size_t k = kFirstAngle; k < kCoordinateNames.size(); ++k) {
      const double off = kDeg * frame.state.q[k] - bin.mean[k];
      squares += off * off;
      inside += std::abs(off) <= std::max(kNarrowestBand_deg, 2 * bin.sd[k]);
      count += 1;
    }
  }
  if (count == 0) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    return {kUnknown, kUnknown};
  }
  return {std::sqrt(squares / count), inside / count};
}

}  // namespace stride::rollout
