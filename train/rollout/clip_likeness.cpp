#include "train/rollout/clip_likeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "train/rollout/gait_summary.h"

namespace stride::rollout {
namespace {

constexpr int kBins = 40;       // of a stride
constexpr int kFirstAngle = 3;  // of kCoordinateNames: hip_flexion_r
constexpr double kDeg = 180 / std::numbers::pi;

/// Mean and deviation of the angles in each part of the clip's stride, in degrees.
class Band {
 public:
  explicit Band(const CalibratedTrajectory& clip) {
    for (const CalibratedSample& sample : clip.samples) {
      Bin& bin = bins_[bin_of(sample.phase)];
      ++bin.count;
      for (std::size_t k = 0; k < kAngles; ++k) {
        const double deg = kDeg * sample.coordinates[kFirstAngle + k];
        bin.sum[k] += deg;
        bin.squares[k] += deg * deg;
      }
    }
  }

  static constexpr std::size_t kAngles = kCoordinateNames.size() - kFirstAngle;

  bool knows(double phase) const { return bins_[bin_of(phase)].count > 0; }
  double mean(double phase, std::size_t k) const {
    const Bin& bin = bins_[bin_of(phase)];
    return bin.sum[k] / bin.count;
  }
  double half_width(double phase, std::size_t k) const {
    const Bin& bin = bins_[bin_of(phase)];
    const double m = bin.sum[k] / bin.count;
    return std::max(kNarrowestBand_deg,
                    2 * std::sqrt(std::max(0.0, bin.squares[k] / bin.count - m * m)));
  }

 private:
  struct Bin {
    int count = 0;
    std::array<double, kAngles> sum{}, squares{};
  };

  static std::size_t bin_of(double phase) {
    const double strides = phase - std::floor(phase);
    return std::min<std::size_t>(static_cast<std::size_t>(strides * kBins), kBins - 1);
  }

  std::array<Bin, kBins> bins_{};
};

}  // namespace

ClipLikeness likeness(const Rollout& rollout, const CalibratedTrajectory& clip,
                      const osim::Model& model, double from_s) {
  std::vector<double> strikes;  // of the right foot
  for (const FootContact& contact : foot_contacts(rollout, model))
    if (contact.side == 0 && contact.start_s >= from_s) strikes.push_back(contact.start_s);
  const Band band(clip);
  double squares = 0, inside = 0, count = 0;
  for (const RolloutFrame& frame : rollout.frames) {
    const auto next = std::ranges::upper_bound(strikes, frame.state.time_s);
    if (next == strikes.begin() || next == strikes.end()) continue;
    const double phase = (frame.state.time_s - *(next - 1)) / (*next - *(next - 1));
    if (!band.knows(phase)) continue;
    for (std::size_t k = 0; k < Band::kAngles; ++k) {
      const double off = kDeg * frame.state.q[kFirstAngle + k] - band.mean(phase, k);
      squares += off * off;
      inside += std::abs(off) <= band.half_width(phase, k);
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
