#include "shaping/potential.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "tests/support/throws.h"

namespace stride {
namespace {

Potential hamner() { return load_potential(STRIDE_TEST_DATA "/hamner.potential.json"); }

/// A pose a few centimetres away from `from`.
Pose nearby(const Pose& from, std::mt19937_64& random, double spread_m) {
  std::uniform_real_distribution<double> offset(-spread_m, spread_m);
  Pose pose = from;
  pose.pelvis_height_m() += offset(random);
  for (const auto part : {PosePart::knee_r, PosePart::foot_r, PosePart::knee_l, PosePart::foot_l})
    pose[part] += Eigen::Vector2d(offset(random), offset(random));
  return pose;
}

double distance(const Pose& a, const Pose& b) {
  double sum = 0;
  for (const ComparedPart& each : kPoseParts) sum += displacement(a, b, each.part).norm();
  return sum;
}

TEST(Potential, HasThePapersClosedForms) {
  Potential potential = hamner();
  potential.weight = 2;
  potential.epsilon_m = 0.01;
  Pose pose = potential.target(0.25);
  pose.pelvis_height_m() += 0.1;
  pose[PosePart::knee_r] += Eigen::Vector2d(0.03, -0.04);
  const double e = 0.01, at_target_pf1 = 3 / e, at_target_pf3 = 3 / (e * e);
  potential.function = InverseDistance::pf1;
  EXPECT_NEAR(potential(pose, 0.25), 2 * (at_target_pf1 + 1 / 0.11 + 1 / 0.08), 1e-9);
  potential.function = InverseDistance::pf2;
  EXPECT_NEAR(potential(pose, 0.25),
              2 * (at_target_pf1 + 1 / std::sqrt(0.01 + e * e) + 1 / std::sqrt(0.0025 + e * e)),
              1e-9);
  potential.function = InverseDistance::pf3;
  EXPECT_NEAR(potential(pose, 0.25),
              2 * (at_target_pf3 + 1 / (0.01 + e * e) + 1 / (0.0025 + e * e)), 1e-6);
}

/// exp(−d²/s²) − 1 with the part's own variance over the stride; 0 on the stride, −5 far from it.
TEST(Potential, Pf4IsASquaredExponentialOfTheKeyframesOwnSpreadNowherePositive) {
  Potential potential = hamner();
  potential.function = InverseDistance::pf4;
  potential.weight = 2;
  potential.epsilon_m = 0.05;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double squares = 0;
  const auto n = static_cast<double>(potential.keyframes.size());
  for (const Keyframe& keyframe : potential.keyframes) mean += keyframe.pose[PosePart::foot_l] / n;
  for (const Keyframe& keyframe : potential.keyframes)
    squares += (keyframe.pose[PosePart::foot_l] - mean).squaredNorm() / n;
  Pose pose = potential.target(0.25);
  EXPECT_NEAR(potential(pose, 0.25), 0, 1e-12);
  pose[PosePart::foot_l] += Eigen::Vector2d(0.03, -0.04);
  EXPECT_NEAR(potential(pose, 0.25), 2 * (std::exp(-0.0025 / (squares + 0.0025)) - 1), 1e-12);
  for (double& m : pose.m) m += 100;
  EXPECT_NEAR(potential(pose, 0.25), -2 * 5, 1e-12);
  potential.index = PotentialIndex::nearest;
  EXPECT_NEAR(potential(pose, 0.25), -2 * 5, 1e-12);
}

TEST(Potential, AVelocityCountsAsADistance) {
  Potential potential = hamner();
  potential.function = InverseDistance::pf3;
  potential.epsilon_m = 0.1;
  potential.weight = 2;
  potential.velocity_s = 0.1;
  MovingPose motion{potential.target(0.25), potential.target_velocity(0.25)};
  EXPECT_NEAR(potential(motion, 0.25), 2 * 5 / 0.01, 1e-9);
  motion.pose[PosePart::foot_l] += Eigen::Vector2d(0, 0.05);
  motion.velocity[PosePart::foot_l] += Eigen::Vector2d(0.6, 0.8);
  EXPECT_NEAR(potential(motion, 0.25), 2 * (4 / 0.01 + 1 / (0.0025 + 0.01 + 0.01)), 1e-9);
  const MovingPose mirrored = motion.mirrored();
  for (const auto& [index, name] : kPotentialIndices) {
    potential.index = index;
    EXPECT_NEAR(potential(mirrored, 0.75), potential(motion, 0.25), 1e-6) << name;
  }
  EXPECT_ERROR(potential(motion.pose, 0.25), "velocities are compared");
}

/// A leg that is turned as a whole about the pelvis has another thigh and the same knee.
TEST(Potential, AnAngleCountsAsADistance) {
  Potential potential = hamner();
  potential.function = InverseDistance::pf3;
  potential.epsilon_m = 0.1;
  potential.weight = 2;
  potential.index = PotentialIndex::time;
  Pose pose = potential.target(0.25);
  const Pose target = pose;
  const double turn = 0.3;
  const Eigen::Rotation2Dd rotation(turn);
  for (const PosePart part : {PosePart::knee_l, PosePart::foot_l})
    pose[part] = (rotation * Eigen::Vector2d(pose[part])).eval();
  const double without = potential(pose, 0.25);
  potential.angle_m = 0.4;
  EXPECT_NEAR(potential(target, 0.25), 2 * 9 / 0.01, 1e-9);
  const double angles = 3 / 0.01 + 1 / (std::pow(0.4 * turn, 2) + 0.01);
  EXPECT_NEAR(potential(pose, 0.25) - without, 2 * angles, 1e-9);
  for (const auto& [function, name] : kInverseDistances)
    for (const auto& [index, index_name] : kPotentialIndices) {
      potential.function = function;
      potential.index = index;
      EXPECT_NEAR(potential(pose.mirrored(), 0.75), potential(pose, 0.25), 1e-6)
          << name << index_name;
      EXPECT_LT(potential(pose, 0.25), potential(target, 0.25));
    }
}

TEST(Potential, TheTargetsVelocityIsThatOfTheTarget) {
  const Potential potential = hamner();
  for (const double phase : {0.0, 0.2, 0.43, 0.9}) {
    const double step_s = 0.001;
    const Pose now = potential.target(phase),
               then = potential.target(phase + step_s / potential.period_s),
               velocity = potential.target_velocity(phase + 0.5 * step_s / potential.period_s);
    for (std::size_t i = 0; i < kPoseNumbers; ++i)
      EXPECT_NEAR(velocity.m[i], (then.m[i] - now.m[i]) / step_s, 1e-3) << i;
  }
}

TEST(Potential, ContrastIsWhatAStrideInItsOwnTimeHasOverOneAtAnyOther) {
  Potential potential = hamner();
  const auto n = static_cast<double>(potential.keyframes.size());
  for (const auto& [function, name] : kInverseDistances) {
    potential.function = function;
    double expected = 0;
    for (const Keyframe& now : potential.keyframes)
      for (const Keyframe& other : potential.keyframes)
        expected += (potential(now.pose, now.phase) - potential(other.pose, now.phase)) / (n * n);
    EXPECT_GT(expected, 0) << name;
    EXPECT_NEAR(potential.contrast(), expected, 1e-9 * expected) << name;
  }
}

TEST(Potential, IsHighestOnTheStride) {
  std::mt19937_64 random(1);
  Potential potential = hamner();
  for (const auto& [function, name] : kInverseDistances) {
    potential.function = function;
    for (int i = 0; i < 50; ++i) {
      const double phase = i / 50.0;
      const Pose on = potential.target(phase), off = nearby(on, random, 0.2);
      EXPECT_GT(potential(on, phase), potential(off, phase)) << name;
    }
  }
}

TEST(Potential, IsBoundedOnTheStrideByEpsilon) {
  Potential potential = hamner();
  potential.epsilon_m = 0.03;
  EXPECT_NEAR(potential(potential.target(0.3), 0.3), 5 / (0.03 * 0.03), 1e-6);
}

TEST(Potential, PassesThroughItsKeyframesAndIsPeriodic) {
  const Potential potential = hamner();
  for (const Keyframe& keyframe : potential.keyframes) {
    EXPECT_LT(distance(potential.target(keyframe.phase), keyframe.pose), 1e-12);
    EXPECT_LT(distance(potential.target(keyframe.phase - 3), keyframe.pose), 1e-12);
  }
}

TEST(Potential, FollowsASineBetweenEightKeyframes) {
  Potential potential = hamner();
  const double turn = 2 * std::numbers::pi;
  for (Keyframe& keyframe : potential.keyframes)
    keyframe.pose[PosePart::foot_r] =
        Eigen::Vector2d(std::cos(turn * keyframe.phase), std::sin(turn * keyframe.phase));
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const double phase = i / 100.0;
    const Eigen::Vector2d truth(std::cos(turn * phase), std::sin(turn * phase));
    worst = std::max(worst, (potential.target(phase)[PosePart::foot_r] - truth).norm());
  }
  EXPECT_LT(worst, 2e-3);  // a periodic cubic spline errs by h⁴/384 · (2π)⁴ = 1.0e-3 in each axis
  EXPECT_GT(worst, 1e-4);  // and is not the sine itself
}

TEST(Potential, OfTheMirroredPoseHalfACycleLaterIsTheSame) {
  std::mt19937_64 random(2);
  Potential potential = hamner();
  for (const auto index : {PotentialIndex::time, PotentialIndex::nearest}) {
    potential.index = index;
    for (int i = 0; i < 40; ++i) {
      const double phase = i / 37.0;
      const Pose pose = nearby(potential.target(phase), random, 0.3);
      EXPECT_NEAR(potential(pose.mirrored(), phase + 0.5), potential(pose, phase),
                  1e-9 * potential(pose, phase));
    }
  }
}

TEST(Potential, OfTheNearestKeyframeDoesNotDependOnPhase) {
  Potential potential = hamner();
  potential.index = PotentialIndex::nearest;
  const Pose pose = potential.keyframes[3].pose;
  EXPECT_EQ(potential(pose, 0.1), potential(pose, 0.9));
  potential.index = PotentialIndex::time;
  EXPECT_NE(potential(pose, 0.1), potential(pose, 0.9));
}

TEST(Potential, AdvancesItsPhaseWithTheCadenceOfTheVideo) {
  Potential potential = hamner();
  potential.period_s = 0.7;
  EXPECT_NEAR(potential.phase_at(0.35), 0.5, 1e-12);
  EXPECT_NEAR(potential.phase_at(0.7 * 13 + 0.07), 0.1, 1e-12);
}

}  // namespace
}  // namespace stride
