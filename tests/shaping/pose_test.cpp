#include "shaping/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace stride {
namespace {

const Pose kPose{{0.9, 0.1, -0.4, 0.2, -0.8, -0.1, -0.5, -0.2, -0.7}};

TEST(Pose, NumbersItsPartsInTheOrderOfTheTable) {
  EXPECT_EQ(kPose.pelvis_height_m(), 0.9);
  EXPECT_EQ(kPose[PosePart::knee_r], Eigen::Vector2d(0.1, -0.4));
  EXPECT_EQ(kPose[PosePart::foot_l], Eigen::Vector2d(-0.2, -0.7));
  std::set<const double*> all;
  for (const ComparedPart& each : kPoseParts)
    for (const double& number : kPose.numbers(each.part)) all.insert(&number);
  EXPECT_EQ(all.size(), kPoseNumbers);
}

TEST(Pose, MirroredExchangesRightAndLeft) {
  const Pose mirrored = kPose.mirrored();
  EXPECT_EQ(mirrored.pelvis_height_m(), 0.9);
  EXPECT_EQ(mirrored[PosePart::knee_r], kPose[PosePart::knee_l]);
  EXPECT_EQ(mirrored[PosePart::foot_l], kPose[PosePart::foot_r]);
  EXPECT_EQ(mirrored.mirrored().m, kPose.m);
}

TEST(Pose, ComparesThePelvisByItsHeightOnly) {
  Pose other = kPose;
  other.pelvis_height_m() += 0.25;
  other[PosePart::foot_r] += Eigen::Vector2d(0.5, -0.125);
  EXPECT_EQ(displacement(kPose, other, PosePart::pelvis), Eigen::Vector2d(0, other.m[0] - 0.9));
  EXPECT_NEAR(displacement(kPose, other, PosePart::foot_r).x(), 0.5, 1e-15);
  EXPECT_EQ(displacement(kPose, other, PosePart::knee_l).norm(), 0);
}

TEST(Pose, AnglesOfALegThatIsBentForwardAtTheHipAndBackAtTheKnee) {
  Pose pose;
  pose[PosePart::knee_r] = Eigen::Vector2d(0.5 * std::sin(0.6), -0.5 * std::cos(0.6));
  pose[PosePart::foot_r] =
      pose[PosePart::knee_r] + Eigen::Vector2d(0.4 * std::sin(-0.3), -0.4 * std::cos(-0.3));
  pose[PosePart::knee_l] = Eigen::Vector2d(0, -0.5);
  pose[PosePart::foot_l] = Eigen::Vector2d(0, -0.9);
  const auto angles = leg_angles(pose);
  EXPECT_NEAR(angles[0], 0.6, 1e-12);
  EXPECT_NEAR(angles[1], 0.9, 1e-12);
  EXPECT_EQ(angles[2], 0);
  EXPECT_EQ(angles[3], 0);
  EXPECT_EQ(leg_angles(pose.mirrored())[3], angles[1]);
}

}  // namespace
}  // namespace stride
