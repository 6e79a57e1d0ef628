// The potential of a movement with a beginning and an end.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shaping/keyframes.h"
#include "shaping/potential.h"
#include "shaping/shaping_reward.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

constexpr double kLasts_s = 1.8;

/// A jump whose pelvis rises and falls and whose feet move forward once.
CalibratedTrajectory jump() {
  CalibratedTrajectory run;
  run.source = "jump.mp4";
  run.movement = "jump";
  run.period_s = kLasts_s;
  for (int i = 0; i <= 180; ++i) {
    CalibratedSample& sample = run.samples.emplace_back();
    sample.time_s = 0.01 * i;
    sample.phase = i / 180.0;
    const double rise = std::pow(std::sin(std::numbers::pi * sample.phase), 4);
    sample.p_m.fill(Eigen::Vector2d::Zero());
    sample.coordinates[2] = 0.9 + 0.2 * rise;
    sample.p_m[index(BodyPart::knee_r)] = {0.1 * rise, -0.4};
    sample.p_m[index(BodyPart::knee_l)] = {0.12 * rise, -0.4};
    sample.p_m[index(BodyPart::ankle_r)] = {0.2 * rise, -0.8 + 0.1 * rise};
    sample.p_m[index(BodyPart::ankle_l)] = {0.2 * rise, -0.8};
  }
  return run;
}

Potential of_jump() { return make_potential(jump(), {}, "jump.calibrated.csv"); }

TEST(Passage, HasKeyframesFromItsBeginningToItsEnd) {
  const Potential potential = of_jump();
  EXPECT_EQ(potential.movement, "jump");
  EXPECT_FALSE(potential.repeats);
  ASSERT_EQ(potential.keyframes.size(), 16U);
  EXPECT_EQ(potential.keyframes.front().phase, 0);
  EXPECT_EQ(potential.keyframes.back().phase, 1);
  EXPECT_NEAR(potential.keyframes[0].pose.pelvis_height_m(), 0.9, 1e-9);
}

TEST(Passage, PassesThroughItsKeyframesAndIsHeldBeforeAndAfter) {
  const Potential potential = of_jump();
  for (const Keyframe& each : potential.keyframes)
    EXPECT_LT((potential.target(each.phase).row() - each.pose.row()).norm(), 1e-12);
  EXPECT_EQ(potential.target(-0.3).m, potential.target(0).m);
  EXPECT_EQ(potential.target(1.7).m, potential.target(1).m);
  const double h = 1e-5;  // at rest at its ends
  EXPECT_LT((potential.target(h).row() - potential.target(0).row()).norm() / h, 1e-2);
  EXPECT_LT((potential.target(1).row() - potential.target(1 - h).row()).norm() / h, 1e-2);
}

TEST(Passage, LiesOnTheMotionBetweenItsKeyframes) {
  const Potential potential = of_jump();
  for (const CalibratedSample& sample : jump().samples)
    EXPECT_NEAR(potential.target(sample.phase).pelvis_height_m(), sample.coordinates[2], 2e-3);
}

TEST(Passage, EndsWithItsPhase) {
  const Potential potential = of_jump();
  EXPECT_NEAR(potential.phase_at(0.9), 0.5, 1e-12);
  EXPECT_EQ(potential.phase_at(5), 1);
}

TEST(Passage, IsReadAsItWasWritten) {
  const TemporaryFolder folder;
  const Potential potential = of_jump();
  save(potential, folder.path() / "jump.potential.json");
  const Potential read = load_potential(folder.path() / "jump.potential.json");
  EXPECT_EQ(read.movement, "jump");
  EXPECT_FALSE(read.repeats);
  EXPECT_EQ(read.mirrored_after, 0);
  EXPECT_EQ(read.target(0.37).m, potential.target(0.37).m);
}

TEST(Passage, NeedsBeginningAndEnd) {
  CalibratedTrajectory half = jump();
  half.samples.resize(90);
  EXPECT_ERROR(make_potential(half, {}, "half.calibrated.csv"),
               "half.calibrated.csv: phases 0.00 to 0.49: a jump is needed");
}

// Σ γᵗ F telescopes over an episode that is longer than the movement, and does so where the target
// stands still.
TEST(Passage, ShapesByRewardsThatTelescope) {
  const Potential potential = of_jump();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> offset(-0.2, 0.2);
  const double gamma = 0.98;
  std::vector<double> phi;
  for (int t = 0; t <= 100; ++t) {
    const double phase = potential.phase_at(0.03 * t);
    Pose pose = potential.target(phase);
    pose[PosePart::knee_l] += Eigen::Vector2d(offset(random), offset(random));
    phi.push_back(potential(pose, phase));
  }
  for (const bool fell : {false, true}) {
    double sum = 0;
    for (int t = 0; t < 100; ++t)
      sum += std::pow(gamma, t) * shaping_reward(phi[t], phi[t + 1], gamma, fell && t == 99);
    EXPECT_NEAR(sum, (fell ? 0 : std::pow(gamma, 100) * phi[100]) - phi[0], 1e-10 * phi[0]);
  }
}

}  // namespace
}  // namespace stride
