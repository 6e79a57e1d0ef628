#include "train/robust_features.h"

#include <fmt/format.h>

#include <algorithm>

#include "train/simulation/contact.h"
#include "train/simulation/sensors.h"

namespace stride {
namespace {

/// Places among the competition's 41 (sensors.h).
enum Index { kTilt = 0, kX = 1, kY = 2, kComX = 18, kStrengthL = 36, kStrengthR = 37, kNext = 38 };
constexpr int kAnglesOfLeg[] = {6, 9};  // hip, knee, ankle of the right, of the left

/// What the competition observes where there is no obstacle.
constexpr double kNone_m = 100;
constexpr double kSame_m = 1e-6;

double clipped(double x) {
  return std::clamp(x, -RobustFeatures::kSight_m, RobustFeatures::kSight_m);
}

}  // namespace

RobustFeatures::RobustFeatures(const Model& model, Rules rules)
    : model_(sagittal_model(model)), rules_(rules) {
  for (int i = 0; i < kComX + 4; ++i)
    if (i != kX) names_.push_back(Sensors::names()[static_cast<std::size_t>(i)]);
  for (const char* side : {"r", "l"})
    for (const char* point : {"talus", "toes"})
      for (const char* axis : {"x", "y"})
        names_.push_back(fmt::format("{}_{}_{}", point, side, axis));
  for (const char* muscle : {"glut_max", "iliopsoas"})
    for (const char* side : {"r", "l"})
      names_.push_back(fmt::format("strength_{}_{}", muscle, side));
  for (const char* name : {"obstacle_near_x", "obstacle_top_y"}) names_.push_back(name);
  for (const char* side : {"r", "l"})
    for (const char* what : {"toes_{}_to_near_side", "talus_{}_to_far_side", "toes_{}_above_top",
                             "talus_{}_above_top"})
      names_.push_back(fmt::format(fmt::runtime(what), side));
}

void RobustFeatures::watch(const Eigen::VectorXd& observation) {
  if (observation[kNext] >= kNone_m) return;
  const Obstacle seen{
      observation[kX] + observation[kNext], observation[kNext + 1],
      rules_ == Rules::nips2017 ? kNominalObstacleRadius_m : observation[kNext + 2]};
  const auto known = [&](const Obstacle& each) {
    return std::abs(each.x_m - seen.x_m) < kSame_m && each.y_m == seen.y_m;
  };
  if (std::ranges::any_of(obstacles_, known)) return;
  obstacles_.push_back(seen);
  std::ranges::sort(obstacles_, {}, &Obstacle::x_m);
}

const Obstacle* RobustFeatures::next(double x) const {
  for (const Obstacle& each : obstacles_)
    if (each.x_m + each.radius_m >= x) return &each;
  return nullptr;
}

void RobustFeatures::write(const Eigen::VectorXd& observation, double* values) const {
  const double x = observation[kX], y = observation[kY];
  for (int i = 0; i < kComX + 4; ++i)
    if (i != kX) *values++ = observation[i] - (i == kComX ? x : 0);

  Eigen::Vector2d ankles[2], toes[2];  // right, left; x from the pelvis
  for (int leg = 0; leg < 2; ++leg) {
    const int angles = kAnglesOfLeg[leg];
    const Leg<double> placed = place_leg(model_, observation[kTilt], observation[angles],
                                         observation[angles + 1], observation[angles + 2]);
    ankles[leg] = placed.ankle + Eigen::Vector2d(0, y);
    toes[leg] = placed.toe + Eigen::Vector2d(0, y);
    for (const Eigen::Vector2d& point : {ankles[leg], toes[leg]})
      *values++ = point.x(), *values++ = point.y();
  }

  const bool clean = rules_ == Rules::clean;  // otherwise the left one is glut_max_l (O3)
  *values++ = 1;
  *values++ = clean ? 1 : observation[kStrengthL];
  *values++ = observation[kStrengthR];
  *values++ = clean ? observation[kStrengthL] : 1;

  const auto near_side = [x](const Obstacle& each) { return each.x_m - each.radius_m - x; };
  const auto in_sight = [&](const Obstacle* each) {
    return each != nullptr && near_side(*each) < kSight_m ? each : nullptr;
  };
  const Obstacle* ahead = in_sight(next(x));
  *values++ = ahead ? clipped(near_side(*ahead)) : kSight_m;
  *values++ = ahead ? ahead->y_m + ahead->radius_m : 0;
  for (int leg = 0; leg < 2; ++leg) {
    const Obstacle* each = in_sight(next(x + ankles[leg].x()));
    const double top = each ? each->y_m + each->radius_m : 0;
    *values++ = each ? clipped(near_side(*each) - toes[leg].x()) : kSight_m;
    *values++ = each ? clipped(each->x_m + each->radius_m - x - ankles[leg].x()) : kSight_m;
    *values++ = toes[leg].y() - top;
    *values++ = ankles[leg].y() - top;
  }
}

}  // namespace stride
