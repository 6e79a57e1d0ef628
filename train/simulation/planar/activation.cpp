#include "train/simulation/planar/activation.h"

#include <algorithm>

namespace stride::planar {

using Fibers = PlanarDynamics::Fibers;

namespace {

Fibers step(const Fibers& from, double h, const Fibers& rate) {
  Fibers to;
  for (int g = 0; g < PlanarDynamics::kGroups; ++g) to[g] = from[g] + h * rate[g];
  return to;
}

}  // namespace

void ActivationTrack::build(const PlanarDynamics& dynamics, const Fibers& start,
                            const Fibers& excitation, double duration_s, int intervals) {
  intervals_ = std::clamp(intervals, 1, kMostNodes);
  const double h = spacing_s_ = duration_s / intervals_;
  const auto rate_at = [&](const Fibers& a) { return dynamics.activation_rate(a, excitation); };
  value_[0] = start;
  rate_[0] = rate_at(start);
  for (int n = 0; n < intervals_; ++n) {
    const Fibers k2 = rate_at(step(value_[n], h / 2, rate_[n]));
    const Fibers k3 = rate_at(step(value_[n], h / 2, k2));
    const Fibers k4 = rate_at(step(value_[n], h, k3));
    for (int g = 0; g < PlanarDynamics::kGroups; ++g) {
      value_[n + 1][g] = value_[n][g] + h / 6 * (rate_[n][g] + 2 * k2[g] + 2 * k3[g] + k4[g]);
    }
    rate_[n + 1] = rate_at(value_[n + 1]);
  }
}

void ActivationTrack::at(double time_s, Fibers& activation) const {
  const double at = time_s / spacing_s_;
  const int n = std::clamp(static_cast<int>(at), 0, intervals_ - 1);
  const double x = at - n, left = 1 - x;
  const double v0 = (1 + 2 * x) * left * left, v1 = x * x * (3 - 2 * x);
  const double r0 = spacing_s_ * x * left * left, r1 = -spacing_s_ * x * x * left;
  for (int g = 0; g < PlanarDynamics::kGroups; ++g) {
    activation[g] =
        v0 * value_[n][g] + v1 * value_[n + 1][g] + r0 * rate_[n][g] + r1 * rate_[n + 1][g];
  }
}

}  // namespace stride::planar
