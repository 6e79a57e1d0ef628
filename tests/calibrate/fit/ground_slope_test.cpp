#include "calibrate/fit/ground_slope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace stride {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A camera that goes along a ground whose image falls to the right by `slope` (y is down).
Trajectory passing(double slope_rad, double px_a_frame, double sway_px, double slipped = 0) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> sway(0, sway_px);
  Trajectory trajectory;
  trajectory.width_px = 640;
  trajectory.height_px = 360;
  for (int i = 0; i < 100; ++i) {
    TrajectoryFrame& frame = trajectory.frames.emplace_back();
    if (i == 0) continue;  // not known of the first
    frame.camera_px = {-px_a_frame, -px_a_frame * std::tan(slope_rad) + sway(random)};
    if (i % 100 < 100 * slipped) frame.camera_px.y() += 50;
  }
  return trajectory;
}

TEST(GroundSlope, IsThatOfTheWayOfTheBackground) {
  for (const double slope : {-3 * kDegree, 0.0, 2 * kDegree}) {
    const auto roll = fit::ground_roll(passing(slope, 20, 0.3));
    ASSERT_TRUE(roll.has_value());
    EXPECT_NEAR(roll->mean, -slope, 0.2 * kDegree);
    EXPECT_LT(roll->sd, 1 * kDegree);
  }
}

TEST(GroundSlope, IsNotMovedByFramesOfSlippedFlow) {
  const auto roll = fit::ground_roll(passing(2 * kDegree, 20, 0.3, 0.15));
  ASSERT_TRUE(roll.has_value());
  EXPECT_NEAR(roll->mean, -2 * kDegree, 0.3 * kDegree);
}

TEST(GroundSlope, OfAMarkedFloorLineComesFirst) {
  Trajectory trajectory = passing(2 * kDegree, 20, 0.3);
  trajectory.floor_roll_rad = 0.05;
  EXPECT_EQ(fit::ground_roll(trajectory)->mean, -0.05);
}

TEST(GroundSlope, IsNotKnownFromACameraThatStandsOrSwaysOrIsNotMeasured) {
  EXPECT_FALSE(fit::ground_roll(passing(0, 2, 0.3)).has_value());  // less than half a frame
  EXPECT_FALSE(fit::ground_roll(passing(0, 4, 5)).has_value());    // not within a degree
  EXPECT_FALSE(fit::ground_roll({}).has_value());
}

}  // namespace
}  // namespace stride
