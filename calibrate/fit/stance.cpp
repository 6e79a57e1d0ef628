#include "calibrate/fit/stance.h"

#include <algorithm>
#include <array>
#include <utility>

namespace stride::fit {
namespace {

constexpr int kPhases = 96;

/// The longest cyclic run of phases that satisfy a condition: first, and one past the last.
std::pair<int, int> longest_run(const std::array<bool, kPhases>& holds) {
  std::pair<int, int> longest{0, 0};
  for (int begin = 0; begin < kPhases; ++begin) {
    int end = begin;
    while (end < begin + kPhases && holds[end % kPhases]) ++end;
    if (end - begin > longest.second - longest.first) longest = {begin, end};
  }
  return longest;
}

/// Displacement of a part backwards from one phase to the next, by least squares over a run of
/// phases, which gives landing, push-off and the noise of single phases little weight.
double displacement_back_m(const std::vector<Eigen::Vector2d>& path, std::pair<int, int> phases) {
  const double middle = 0.5 * (phases.first + phases.second - 1);
  double sum_x = 0, squares = 0;
  for (int i = phases.first; i < phases.second; ++i) {
    sum_x += (i - middle) * path[i % kPhases].x();
    squares += (i - middle) * (i - middle);
  }
  return squares > 0 ? -sum_x / squares : 0;
}

}  // namespace

Stance find_stance(const StrideFit& fit, const Directions& directions, BodyPart part) {
  // Heights above the lowest in leg lengths: certain stance, and the phases used for the speed.
  constexpr double kStands = 0.025, kLow = 0.05;
  const Runner& r = fit.runner;
  const int side = side_of(part);
  std::vector<Eigen::Vector2d> path;
  for (int i = 0; i < kPhases; ++i) {
    const double phase = static_cast<double>(i) / kPhases;
    const auto leg = leg_angles(r.hip.data(), r.knee.data(), r.ankle.data(), r.asymmetry.data(),
                                fit.harmonics, side, phase);
    const double tilt = evaluate_series(r.tilt.data(), kTiltHarmonics, phase);
    path.emplace_back(
        place_part(part, directions, r.body.data(), r.sides.data(), tilt, leg, phase) +
        Eigen::Vector2d(0, fit.vertical_oscillation(phase)));
  }
  double lowest_m = path.front().y();
  for (const Eigen::Vector2d& p : path) lowest_m = std::min(lowest_m, p.y());
  const double leg_m = r.body[body::thigh] + r.body[body::shank];
  Stance stance;
  std::array<bool, kPhases> low{};
  for (int i = 0; i < kPhases; ++i) {
    if (path[(i + kPhases - 1) % kPhases].x() <= path[(i + 1) % kPhases].x()) continue;
    const double height_m = path[i].y() - lowest_m;
    if (height_m < kStands * leg_m) stance.phases.push_back(static_cast<double>(i) / kPhases);
    low[i] = height_m < kLow * leg_m;
  }
  stance.speed_m_s =
      displacement_back_m(path, longest_run(low)) * kPhases / r.cadence[cadence::period_s];
  return stance;
}

}  // namespace stride::fit
