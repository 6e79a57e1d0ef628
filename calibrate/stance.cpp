#include "calibrate/stance.h"

#include <algorithm>

namespace stride {

Stance find_stance(const StrideFit& fit, const Directions& directions, BodyPart part) {
  constexpr int kPhases = 96;
  constexpr double kLow = 0.025;  // of a leg's length
  const Runner& r = fit.runner;
  const int side = side_of(part);
  std::vector<Eigen::Vector2d> path;
  for (int i = 0; i < kPhases; ++i) {
    const double phase = static_cast<double>(i) / kPhases;
    const auto leg = leg_angles(r.hip.data(), r.knee.data(), r.ankle.data(), r.asymmetry.data(),
                                fit.harmonics, side, phase);
    const double tilt = evaluate_series(r.tilt.data(), 2, phase);
    path.push_back(place_part(part, directions, r.body.data(), r.sides.data(), tilt, leg, phase) +
                   Eigen::Vector2d(0, fit.bounce(phase)));
  }
  const auto lowest =
      std::ranges::min_element(path, {}, [](const Eigen::Vector2d& p) { return p.y(); });
  const double low = lowest->y() + kLow * (r.body[body::thigh] + r.body[body::shank]);
  Stance stance;
  double back_m = 0;  // a phase
  for (int i = 0; i < kPhases; ++i) {
    const double step = path[(i + kPhases - 1) % kPhases].x() - path[(i + 1) % kPhases].x();
    if (path[i].y() >= low || step <= 0) continue;
    stance.phases.push_back(static_cast<double>(i) / kPhases);
    back_m += step / 2;
  }
  if (!stance.phases.empty())
    stance.speed_m_s =
        back_m / static_cast<double>(stance.phases.size()) * kPhases / r.cadence[cadence::period_s];
  return stance;
}

}  // namespace stride
