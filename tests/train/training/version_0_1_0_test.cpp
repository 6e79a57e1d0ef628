// Files that version 0.1.0 wrote are still read.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>

#include "calibrate/runner/calibrated.h"
#include "extract/skeleton/keypoints.h"
#include "extract/skeleton/trajectory.h"
#include "shaping/potential.h"
#include "tests/support/temporary_folder.h"
#include "train/network/policy.h"
#include "train/training/runner_factory.h"
#include "train/training/train.h"

namespace stride {
namespace {

namespace fs = std::filesystem;
const fs::path kFiles = STRIDE_TEST_DATA "/../../data/version_0_1_0";

TEST(Version010, ClicksAndTrajectories) {
  const Keypoints clicks = load_keypoints(kFiles / "small.keypoints.json");
  EXPECT_EQ(clicks.video, "small.mp4");
  ASSERT_EQ(clicks.frames.size(), 2U);
  EXPECT_EQ(clicks.frames.at(0)[BodyPart::pelvis]->p_px, Eigen::Vector2d(167.14, 93.38));
  const Trajectory trajectory = load_trajectory(kFiles / "human.trajectory.csv");
  EXPECT_EQ(trajectory.frames.size(), 30U);
  EXPECT_NEAR(trajectory.rate_hz, 30, 1e-9);
  EXPECT_EQ(trajectory.frames[0][BodyPart::knee_r].p_px.x(), 324.17594384639193);
}

TEST(Version010, CalibratedRunsAndPotentials) {
  const CalibratedTrajectory run = load_calibrated(kFiles / "run/reference.calibrated.csv");
  EXPECT_EQ(run.samples.size(), 76U);
  EXPECT_NEAR(run.period_s, 0.6867, 1e-4);
  const Potential potential = load_potential(kFiles / "run/potential.json");
  EXPECT_EQ(potential.keyframes.size(), 8U);
  EXPECT_NEAR(potential.period_s, 0.6867, 1e-4);
}

TEST(Version010, Policies) {
  const network::PolicyNames names = network::load_policy_names(kFiles / "run/agent.safetensors");
  EXPECT_EQ(names.actions.size(), 18U);
  const auto policy =
      network::load_policy<float>(kFiles / "run/agent.safetensors", names.features, names.actions);
  EXPECT_GT(policy.actor.parameters().size(), 18);
}

TEST(Version010, RunsGoOnFromTheirCheckpoints) {
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  fs::copy(kFiles / "run", run, fs::copy_options::recursive);
  training::TrainOptions options = training::load_run_options(run);
  EXPECT_EQ(options.exploration.sigma_ratio, 2);
  EXPECT_EQ(options.exploration.noise_free_fraction, 0.05);
  const std::atomic<bool> never = false;
  const auto train = [&](std::int64_t decisions) {
    options.run.decisions = decisions;
    training::write_run_options(options, run);
    return training::train(
        run,
        training::make_runners(options.environment, training::load_run_demonstration(options, run)),
        never, nullptr);
  };
  const training::TrainSummary continued = train(100);
  EXPECT_TRUE(continued.finished);
  EXPECT_EQ(continued.progress.rows, 4);
  EXPECT_GE(continued.progress.decisions, 100);
  EXPECT_EQ(load_table(run / "curve.csv", "curve", 1).rows[1][0], 46);
  EXPECT_TRUE(train(120).finished);  // now from a checkpoint of this version
}

}  // namespace
}  // namespace stride
