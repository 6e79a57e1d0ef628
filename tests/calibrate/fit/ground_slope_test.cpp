#include "calibrate/fit/ground_slope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "extract/skeleton/units.h"
#include "tests/calibrate/rendered.h"
#include "videos/truth.h"

namespace stride {
namespace {

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

/// The runner stays in the middle of the picture, or moves in it as the background does.
Trajectory followed(double slope_rad, double tilt_px_a_frame) {
  Trajectory trajectory = passing(slope_rad, 20, 0.3);
  for (std::size_t i = 0; i < trajectory.frames.size(); ++i) {
    TrajectoryFrame& frame = trajectory.frames[i];
    const double tilted_px = tilt_px_a_frame * static_cast<double>(i);
    frame[BodyPart::pelvis] = {
        {320, 180 + 4 * std::sin(0.6 * static_cast<double>(i)) + tilted_px}, Source::tracked, 0.9};
    frame.camera_px.y() += tilt_px_a_frame;
  }
  return trajectory;
}

TEST(GroundSlope, IsNotKnownFromACameraThatTilts) {
  EXPECT_FALSE(fit::camera_turns(followed(2 * kDegree, 0)));
  EXPECT_TRUE(fit::ground_roll(followed(2 * kDegree, 0)).has_value());
  const Trajectory tilting = followed(0, 1.4);  // four degrees, as if the ground fell
  EXPECT_TRUE(fit::camera_turns(tilting));
  EXPECT_FALSE(fit::ground_roll(tilting).has_value());
  Trajectory marked = tilting;
  marked.floor_roll_rad = 0.01;
  EXPECT_EQ(fit::ground_roll(marked)->mean, -0.01);
}

/// Of rendered runners before cameras that tilt, zoom, or both, half of them by more than the
/// background can tell.
TEST(GroundSlope, OfCamerasThatTiltAndZoomIsInsideItsBandOrNotGiven) {
  int given = 0, inside = 0, asked = 0, none = 0;
  for (const char* name : {"human", "left", "game"})
    for (unsigned seed = 1; seed <= 60; ++seed) {
      const videos::Clip clip = turned_camera(varied(videos::clip(name), seed), seed);
      const Trajectory seen = observed(clip, {true, clip.click_sd_px, seed});
      const auto roll = fit::ground_roll(seen);
      if (!roll) {
        ++none;
        asked += fit::camera_turns(seen);
        continue;
      }
      ++given;
      inside += std::abs(roll->mean - clip.camera.roll_rad) < 1.96 * roll->sd;
    }
  EXPECT_GE(given, 40);
  EXPECT_GE(inside, 0.95 * given) << "of " << given;
  EXPECT_EQ(asked, none);
}

TEST(GroundSlope, IsNotKnownFromACameraThatStandsOrSwaysOrIsNotMeasured) {
  EXPECT_FALSE(fit::ground_roll(passing(0, 2, 0.3)).has_value());  // less than half a frame
  EXPECT_FALSE(fit::ground_roll(passing(0, 4, 5)).has_value());    // not within a degree
  EXPECT_FALSE(fit::ground_roll({}).has_value());
}

}  // namespace
}  // namespace stride
