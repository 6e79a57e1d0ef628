#include "train/environment/robust_features.h"

#include <fmt/format.h>

#include <algorithm>

#include "train/simulation/laws/contact.h"

namespace stride::environment {
namespace {

/// Places among the competition's 41 (sensors.h).
enum Index { kTilt = 0, kX = 1, kY = 2, kStrengthL = 36, kStrengthR = 37, kNext = 38 };
constexpr int kAnglesOfLeg[] = {6, 9};  // hip, knee, ankle of the right, of the left

constexpr double kNone_m = 100;  // what is observed where there is no obstacle
constexpr double kSame_m = 1e-6;

double clipped(double x) {
  return std::clamp(x, -RobustFeatures::kObstacleRange_m, RobustFeatures::kObstacleRange_m);
}

double near_side(const simulation::Obstacle& obstacle) { return obstacle.x_m - obstacle.radius_m; }
double far_side(const simulation::Obstacle& obstacle) { return obstacle.x_m + obstacle.radius_m; }

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const char* side : {"r", "l"})
    for (const char* point : {"ankle", "toe"})
      for (const char* axis : {"x", "y"})
        names.push_back(fmt::format("{}_{}_{}", point, side, axis));
  for (const char* muscle : {"glut_max", "iliopsoas"})
    for (const char* side : {"r", "l"})
      names.push_back(fmt::format("strength_{}_{}", muscle, side));
  names.insert(names.end(), {"obstacle_near_x", "obstacle_top_y"});
  for (const char* side : {"r", "l"}) {
    names.push_back(fmt::format("toe_{}_to_near_side", side));
    names.push_back(fmt::format("ankle_{}_to_far_side", side));
    names.push_back(fmt::format("toe_{}_above_top", side));
    names.push_back(fmt::format("ankle_{}_above_top", side));
  }
  return names;
}

}  // namespace

RobustFeatures::RobustFeatures(const osim::Model& model, competition::Rules rules)
    : model_(sagittal_model(model)), rules_(rules) {}

const std::vector<std::string>& RobustFeatures::names() {
  static const std::vector<std::string> names = all_names();
  return names;
}

void RobustFeatures::remember(const Eigen::VectorXd& observation) {
  if (observation[kNext] >= kNone_m) return;
  const simulation::Obstacle seen{observation[kX] + observation[kNext], observation[kNext + 1],
                                  rules_ == competition::Rules::nips2017
                                      ? laws::kNominalObstacleRadius_m
                                      : observation[kNext + 2]};
  const auto same = [&](const simulation::Obstacle& each) {
    return std::abs(each.x_m - seen.x_m) < kSame_m && each.y_m == seen.y_m;
  };
  if (std::ranges::any_of(obstacles_, same)) return;
  obstacles_.push_back(seen);
  std::ranges::sort(obstacles_, {}, &simulation::Obstacle::x_m);
}

const simulation::Obstacle* RobustFeatures::next(double x, double pelvis_x) const {
  const auto found = std::ranges::find_if(
      obstacles_, [x](const simulation::Obstacle& each) { return far_side(each) >= x; });
  const bool in_range =
      found != obstacles_.end() && near_side(*found) - pelvis_x < kObstacleRange_m;
  return in_range ? &*found : nullptr;
}

void RobustFeatures::read(const Eigen::VectorXd& observation, double* values) {
  remember(observation);
  const auto put = [&](std::initializer_list<double> some) {
    values = std::copy(some.begin(), some.end(), values);
  };
  const double x = observation[kX], y = observation[kY];
  Leg<double> legs[2];  // from the pelvis; right, left
  for (int side = 0; side < 2; ++side) {
    const int i = kAnglesOfLeg[side];
    legs[side] = place_leg(model_, observation[kTilt], observation[i], observation[i + 1],
                           observation[i + 2]);
    put({legs[side].ankle.x(), legs[side].ankle.y() + y, legs[side].toe.x(),
         legs[side].toe.y() + y});
  }
  const bool clean = rules_ == competition::Rules::clean;  // otherwise the left one is glut_max_l
  put({1, clean ? 1 : observation[kStrengthL]});
  put({observation[kStrengthR], clean ? observation[kStrengthL] : 1});

  const simulation::Obstacle* ahead = next(x, x);
  put({ahead ? clipped(near_side(*ahead) - x) : kObstacleRange_m,
       ahead ? ahead->y_m + ahead->radius_m : 0});
  for (const Leg<double>& leg : legs) {
    const simulation::Obstacle* each = next(x + leg.ankle.x(), x);
    const double top = each ? each->y_m + each->radius_m : 0;
    put({each ? clipped(near_side(*each) - x - leg.toe.x()) : kObstacleRange_m,
         each ? clipped(far_side(*each) - x - leg.ankle.x()) : kObstacleRange_m,
         leg.toe.y() + y - top, leg.ankle.y() + y - top});
  }
}

}  // namespace stride::environment
