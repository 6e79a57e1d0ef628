// The agents in train/agents do what is said of them, in the engine that they were trained in and
// in the reference.
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "train/evaluation/evaluate.h"

namespace stride {
namespace {

class ShippedAgent : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedAgent, RunsWithItsLegsInTurn) {
  const TemporaryFolder folder;
  evaluation::EvaluateOptions options;
  options.engine = GetParam();
  options.film = false;
  options.out = folder / "evaluation";
  const evaluation::Evaluation evaluation =
      evaluation::evaluate(STRIDE_SOURCE_DIR "/train/agents/stride", options);
  EXPECT_GT(evaluation.statistics.distance_m, 35);  // 44.8 in either: the last digits decide
  EXPECT_EQ(evaluation.statistics.falls, 0);
  EXPECT_NEAR(evaluation.gait.leg_phase, 0.5, 0.1);
  EXPECT_TRUE(std::filesystem::exists(options.out / "evaluation.mot"));
}

INSTANTIATE_TEST_SUITE_P(Engines, ShippedAgent, ::testing::Values("planar", "simbody"),
                         [](const auto& engine) { return std::string(engine.param); });

TEST(ShippedWalk, IsTheClips) {
  const TemporaryFolder folder;
  evaluation::EvaluateOptions options;
  options.agent = "agent";
  options.film = false;
  options.out = folder / "evaluation";
  options.clip = STRIDE_SOURCE_DIR "/train/results/walk/walk.calibrated.csv";
  const evaluation::Evaluation evaluation =
      evaluation::evaluate(STRIDE_SOURCE_DIR "/train/agents/walk", options);
  EXPECT_EQ(evaluation.statistics.falls, 0);
  EXPECT_GT(evaluation.gait.speed_m_s, 1);
  EXPECT_LT(evaluation.gait.speed_m_s, 1.4);
  EXPECT_GT(evaluation.gait.duty_factor, 0.55);
  EXPECT_NEAR(evaluation.gait.leg_phase, 0.5, 0.1);
  EXPECT_EQ(evaluation.gait.flight_share, 0);
  ASSERT_TRUE(evaluation.similarity);
  EXPECT_GT(evaluation.similarity->inside_share, 0.7);  // 0.86; in Simbody 0.88
}

}  // namespace
}  // namespace stride
