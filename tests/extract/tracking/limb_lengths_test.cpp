#include "extract/tracking/limb_lengths.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr int kSwingFrames = 40;
constexpr double kNoise_legs = 0.015;

/// A leg of 100 px that swings, and the other half a stride behind; all points equally sure.
Trajectory swinging_legs() {
  Trajectory points;
  for (int i = 0; i < kSwingFrames; ++i) {
    TrajectoryFrame& frame = points.frames.emplace_back();
    frame.frame = i;
    frame.time_s = i / 30.0;
    const auto put = [&](BodyPart part, const Vector2d& p) {
      frame[part] = {p, Source::detected, 0.6};
    };
    put(BodyPart::pelvis, {100.0 + i, 100});
    for (const bool left : {false, true}) {
      const double thigh = 0.6 * std::sin(0.3 * i + (left ? 3.14 : 0)), shank = thigh - 0.5;
      const Vector2d knee =
          frame[BodyPart::pelvis].p_px + 50 * Vector2d(std::sin(thigh), std::cos(thigh));
      put(left ? BodyPart::knee_l : BodyPart::knee_r, knee);
      put(left ? BodyPart::ankle_l : BodyPart::ankle_r,
          knee + 50 * Vector2d(std::sin(shank), std::cos(shank)));
    }
  }
  return points;
}

TEST(LimbLengths, LeaveABodyAlone) {
  Trajectory points = swinging_legs();
  EXPECT_EQ(doubt_broken_limbs(points, kNoise_legs), 0);
  for (const TrajectoryFrame& frame : points.frames)
    for (const BodyPart part : kRequiredParts) EXPECT_NEAR(frame[part].confidence, 0.6, 1e-6);
}

TEST(LimbLengths, TellWhichPointIsToBlame) {
  Trajectory points = swinging_legs();
  TrajectoryFrame& frame = points.frames[20];
  const Vector2d up = 0.4 * (frame[BodyPart::pelvis].p_px - frame[BodyPart::knee_r].p_px);
  frame[BodyPart::knee_r].p_px += up;
  const Trajectory before = points;
  EXPECT_EQ(doubt_broken_limbs(points, kNoise_legs), 1);
  EXPECT_LT(frame[BodyPart::knee_r].confidence, 0.2);
  EXPECT_GT(frame[BodyPart::pelvis].confidence, 2 * frame[BodyPart::knee_r].confidence);
  EXPECT_GT(frame[BodyPart::ankle_r].confidence, frame[BodyPart::knee_r].confidence);
  EXPECT_GT(frame[BodyPart::knee_l].confidence, 0.5);
  EXPECT_GT(points.frames[21][BodyPart::knee_r].confidence, 0.59);
  EXPECT_EQ(frame[BodyPart::knee_r].p_px, before.frames[20][BodyPart::knee_r].p_px);
}

TEST(LimbLengths, SayNothingOfFewFrames) {
  Trajectory points = swinging_legs();
  points.frames.resize(3);
  points.frames[1][BodyPart::knee_r].p_px.y() += 60;
  doubt_broken_limbs(points, kNoise_legs);
  EXPECT_EQ(points.frames[1][BodyPart::knee_r].confidence, 0.6);
}

}  // namespace
}  // namespace stride::tracking
