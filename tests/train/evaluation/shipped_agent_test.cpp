// The agent in train/agents runs as its README says, in the engine that it was trained in and in
// the reference.
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
  EXPECT_GT(evaluation.distance_m, 35);  // 44.8 in either: the last digits decide
  EXPECT_EQ(evaluation.falls, 0);
  EXPECT_NEAR(evaluation.gait.leg_phase, 0.5, 0.1);
  EXPECT_TRUE(std::filesystem::exists(options.out / "evaluation.mot"));
}

INSTANTIATE_TEST_SUITE_P(Engines, ShippedAgent, ::testing::Values("planar", "simbody"),
                         [](const auto& engine) { return std::string(engine.param); });

}  // namespace
}  // namespace stride
