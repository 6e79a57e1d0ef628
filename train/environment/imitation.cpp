#include "train/environment/imitation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/runner/phase_bins.h"
#include "extract/io/error.h"
#include "extract/skeleton/movement.h"

namespace stride::environment {
namespace {

constexpr int kBins = 100;         // of a stride; strides are averaged in each
constexpr double kRate_rad_s = 3;  // of the difference of rates that leaves 1/e
constexpr double kOfAngles = 0.8;  // their share in the similarity

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

template <typename Angles>
double mean_square(const Angles& a, const Angles& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum / static_cast<double>(a.size());
}

}  // namespace

Imitation::Imitation(const CalibratedTrajectory& clip, const ImitationOptions& options)
    : options_(options), repeats_(movement(clip.movement).repeats), period_s_(clip.period_s) {
  require(options.reward_per_s >= 0 && options.angle_deg > 0 && options.end_deg >= 0,
          "imitation: reward_per_s and end_deg must be at least 0, angle_deg above 0");
  require(period_s_ > 0, "{}: its period is not known, imitation needs it", clip.source);
  for (const PhaseBin& bin : phase_bins(clip, kBins)) {
    if (bin.count == 0) continue;
    Knot knot{.phase = bin.phase};
    for (std::size_t k = 0; k < kAngles.size(); ++k) knot.angle[k] = bin.mean[kAngles[k]];
    knots_.push_back(knot);
  }
  require(knots_.size() >= 3, "{}: too short to be imitated", clip.source);
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    const std::size_t last = knots_.size() - 1;
    const Knot& before = knots_[i > 0 ? i - 1 : repeats_ ? last : 0];
    const Knot& after = knots_[i < last ? i + 1 : repeats_ ? 0 : last];
    double phase = after.phase - before.phase;
    if (phase < 0) phase += 1;
    for (std::size_t k = 0; k < kAngles.size(); ++k)
      knots_[i].rate[k] = (after.angle[k] - before.angle[k]) / (phase * period_s_);
  }
}

double Imitation::phase_at(double initial_phase, double time_s) const {
  const double phase = initial_phase + time_s / period_s_;
  return repeats_ ? phase - std::floor(phase) : std::clamp(phase, 0.0, 1.0);
}

Imitation::Knot Imitation::at(double phase) const {
  const auto next = std::ranges::upper_bound(knots_, phase, {}, &Knot::phase);
  const bool outside = next == knots_.begin() || next == knots_.end();
  if (outside && !repeats_) {  // it stands still
    Knot still = next == knots_.begin() ? knots_.front() : knots_.back();
    still.rate = {};
    return still;
  }
  const Knot &before = outside ? knots_.back() : *(next - 1),
             &after = outside ? knots_.front() : *next;
  const double between = after.phase - before.phase + (outside ? 1 : 0);
  double since = phase - before.phase;
  if (since < 0) since += 1;
  Knot knot;
  knot.phase = phase;
  for (std::size_t k = 0; k < kAngles.size(); ++k) {
    knot.angle[k] = std::lerp(before.angle[k], after.angle[k], since / between);
    knot.rate[k] = std::lerp(before.rate[k], after.rate[k], since / between);
  }
  return knot;
}

double Imitation::similarity(const simulation::RunnerState& state, double phase) const {
  const Knot clip = at(phase);
  Angles angle{}, rate{};
  for (std::size_t k = 0; k < kAngles.size(); ++k) {
    angle[k] = state.q[kAngles[k]];
    rate[k] = state.u[kAngles[k]];
  }
  const double width = radians(options_.angle_deg);
  return kOfAngles * std::exp(-mean_square(angle, clip.angle) / (width * width)) +
         (1 - kOfAngles) * std::exp(-mean_square(rate, clip.rate) / (kRate_rad_s * kRate_rad_s));
}

bool Imitation::ends(const simulation::RunnerState& state, double phase) const {
  if (options_.end_deg == 0) return false;
  Angles angle{};
  for (std::size_t k = 0; k < kAngles.size(); ++k) angle[k] = state.q[kAngles[k]];
  const double limit = radians(options_.end_deg);
  return mean_square(angle, at(phase).angle) > limit * limit;
}

}  // namespace stride::environment
