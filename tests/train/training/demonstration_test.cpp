#include "train/training/demonstration.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

namespace fs = std::filesystem;

Potential clip_potential() {
  Potential potential;
  potential.source = "clip.mp4";
  potential.model = "gait9dof18musc";
  potential.period_s = 0.7;
  for (int k = 0; k < 8; ++k) {
    Keyframe key;
    key.phase = k / 8.0;
    key.pose = {{1, 0.1, -0.4, 0.1, -0.8, -0.1, -0.4, -0.3, -0.7}};
    potential.keyframes.push_back(key);
  }
  return potential;
}

CalibratedTrajectory some_run() {
  CalibratedTrajectory run;
  run.source = "clip.mp4";
  run.model = "gait9dof18musc";
  run.period_s = 0.7;
  for (int i = 0; i < 80; ++i) {
    CalibratedSample sample;
    sample.time_s = 0.01 * i;
    sample.phase = std::fmod(sample.time_s / 0.7, 1);
    for (auto& p : sample.p_m) p = {0.1, -0.4};
    run.samples.push_back(sample);
  }
  return run;
}

struct DemonstrationTest : ::testing::Test {
  TemporaryFolder folder;
  fs::path potential = folder / "clip.potential.json";
  training::EnvironmentOptions starts_on_reference;

  void SetUp() override {
    save(clip_potential(), potential);
    starts_on_reference.reference_share = 0.5;
  }
};

TEST_F(DemonstrationTest, TheRunOfTheVideoIsFoundBesideThePotential) {
  save(some_run(), folder / "clip.calibrated.csv");
  const training::Demonstration found =
      training::load_demonstration(potential, {}, starts_on_reference);
  EXPECT_TRUE(found.potential);
  ASSERT_TRUE(found.reference);
  EXPECT_EQ(found.reference->samples.size(), 80u);
}

TEST_F(DemonstrationTest, AMissingRunIsAnErrorWithTheCureUnlessNoEpisodeStartsOnIt) {
  EXPECT_ERROR(training::load_demonstration(potential, {}, starts_on_reference),
               "clip.calibrated.csv");
  EXPECT_ERROR(training::load_demonstration(potential, {}, starts_on_reference), "--reference");
  training::EnvironmentOptions starts_as_the_rules_say;
  starts_as_the_rules_say.reference_share = 0;
  EXPECT_FALSE(training::load_demonstration(potential, {}, starts_as_the_rules_say).reference);
  EXPECT_FALSE(training::load_demonstration({}, {}, starts_on_reference).reference);  // a baseline
}

TEST_F(DemonstrationTest, WhatIsImitatedIsNeededEvenWhereNoEpisodeStartsOnIt) {
  training::EnvironmentOptions imitates;
  imitates.reference_share = 0;
  imitates.imitation.reward_per_s = 1;
  EXPECT_ERROR(training::load_demonstration(potential, {}, imitates),
               "--set imitation.reward_per_s=0");
  EXPECT_ERROR(training::load_demonstration({}, {}, imitates), "imitation.reward_per_s: needs");
  save(some_run(), folder / "clip.calibrated.csv");
  EXPECT_TRUE(training::load_demonstration(potential, {}, imitates).reference);
}

TEST_F(DemonstrationTest, WhatIsNoRunOnThisModelIsRefused) {
  const auto expect_refused = [&](auto change, const char* why) {
    Potential spoilt = clip_potential();
    change(spoilt);
    save(spoilt, potential);
    EXPECT_ERROR(training::load_demonstration(potential, {}, {}), why);
  };
  expect_refused([](Potential& p) { p.verdict = "refused: nobody runs here"; },
                 "the clip behind it was refused");
  expect_refused([](Potential& p) { p.period_s = 5.49; }, "--slow-motion");
  expect_refused([](Potential& p) { p.speed_m_s = 18.6; }, "faster than anybody");
  expect_refused([](Potential& p) { p.model = "giraffe"; }, "was made on the model giraffe");
  expect_refused([](Potential& p) { p.keyframes[3].pose.pelvis_height_m() = 2.4; },
                 "the pelvis is 2.40 m high");
}

TEST_F(DemonstrationTest, TheRunFolderHoldsCopiesAndNamesThem) {
  const fs::path run = folder / "run";
  training::TrainOptions options;
  options.environment = starts_on_reference;
  options.shaping.scale = 0.5;
  options.shaping.epsilon_m = 0.2;
  options.shaping.function = "pf1";
  options.shaping.index = "nearest";
  training::save({.potential = clip_potential(), .reference = some_run()}, run, options);
  EXPECT_EQ(options.shaping.potential, "potential.json");
  EXPECT_EQ(options.environment.reference, "reference.calibrated.csv");

  const training::Demonstration loaded = training::load_run_demonstration(options, run);
  EXPECT_EQ(loaded.reference->samples.size(), 80u);
  EXPECT_EQ(loaded.potential->weight, 0.5 * clip_potential().weight);
  EXPECT_EQ(loaded.potential->epsilon_m, 0.2);
  EXPECT_EQ(loaded.potential->function, inverse_distance("pf1"));
  EXPECT_EQ(loaded.potential->index, PotentialIndex::nearest);
}

/// Being in step is worth the same share of a stride's reward whatever function and clip are.
TEST_F(DemonstrationTest, WeighsByTheRewardOfAStride) {
  training::TrainOptions options;
  options.environment.reference_share = 0;
  options.shaping.stride_share = 0.1;
  Potential potential = clip_potential();
  potential.speed_m_s = 4;
  for (Keyframe& keyframe : potential.keyframes)
    keyframe.pose[PosePart::knee_r].x() += 0.1 * std::cos(2 * std::numbers::pi * keyframe.phase);
  training::save({.potential = potential, .reference = {}}, folder / "run", options);
  const double stride_m = 4 * potential.period_s;
  for (const std::string function : {"pf1", "pf3", "pf4"}) {
    options.shaping.function = function;
    options.run.learner = "ddpg";
    const auto ddpg = training::load_run_demonstration(options, folder / "run").potential;
    EXPECT_NEAR(ddpg->contrast(), 0.1 * stride_m * options.reward.scale, 1e-9) << function;
    options.run.learner = "ppo";
    const auto ppo = training::load_run_demonstration(options, folder / "run").potential;
    EXPECT_NEAR(ppo->contrast(), 0.1 * stride_m, 1e-9) << function;
  }
}

TEST_F(DemonstrationTest, ABaselineHasNothingOfAVideo) {
  training::TrainOptions options;
  options.environment = starts_on_reference;
  training::save({}, folder / "run", options);
  EXPECT_EQ(options.environment.reference_share, 0);
  const training::Demonstration loaded = training::load_run_demonstration(options, folder / "run");
  EXPECT_FALSE(loaded.potential);
  EXPECT_FALSE(loaded.reference);
}

}  // namespace
}  // namespace stride
