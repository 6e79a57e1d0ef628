#include "train/training/options.h"

#include <gtest/gtest.h>

#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

TEST(Options, ReadBackFromTheirToml) {
  TemporaryFolder folder;
  training::TrainOptions options;
  options.run.seed = 123456789012345;
  options.agent.gamma = 0.1 + 0.2;
  options.agent.actor_hidden = {400, 300};
  options.agent.critic_hidden = {7};
  options.replay.mirror = false;
  options.shaping.function = "pf2";
  write_file_atomically(folder / "a.toml", training::to_toml(options, "# heading\n"));
  training::TrainOptions read;
  training::read_toml(folder / "a.toml", read);
  EXPECT_EQ(training::to_toml(read, ""), training::to_toml(options, ""));
  EXPECT_EQ(read.agent.actor_hidden, options.agent.actor_hidden);
  EXPECT_EQ(read.agent.gamma, options.agent.gamma);
}

TEST(Options, UnknownKeysAreRefusedWithTheNearestKnownOne) {
  TemporaryFolder folder;
  training::TrainOptions options;
  write_file_atomically(folder / "a.toml", "[agent]\ngama = 0.9\n");
  EXPECT_ERROR(training::read_toml(folder / "a.toml", options),
               "a.toml: agent.gama: unknown key; did you mean "
               "agent.gamma?");
  EXPECT_ERROR(training::set_option("run.sed=3", options), "did you mean run.seed?");
}

TEST(Options, ValuesOfAnotherKindAreNamed) {
  training::TrainOptions options;
  EXPECT_ERROR(training::set_option("agent.gamma=high", options),
               "agent.gamma = high: must be a number");
  EXPECT_ERROR(training::set_option("run.seed=1.5", options),
               "run.seed = 1.5: must be a whole number");
  EXPECT_ERROR(training::set_option("agent.layer_norm=3", options), "must be true or false");
  EXPECT_ERROR(training::set_option("agent.gamma", options), "KEY=VALUE");
}

TEST(Options, ValuesOutOfRangeAreNamedWithTheRange) {
  const auto check = [](const char* assignment) {
    training::TrainOptions options;
    training::set_option(assignment, options);
    options.check();
  };
  EXPECT_ERROR(check("agent.gamma=1"), "agent.gamma = 1: must be in [0, ");
  EXPECT_ERROR(check("agent.gamma=nan"), "agent.gamma = nan: must be finite");
  EXPECT_ERROR(check("run.environments=0"), "run.environments = 0: must be in [1, ");
  EXPECT_ERROR(check("agent.actor_hidden=[64,0]"), "agent.actor_hidden = [64, 0]");
  EXPECT_ERROR(check("run.precision=half"), "must be one of float, double");
  EXPECT_ERROR(check("environment.reference_share=1.5"), "environment.reference_share = 1.5");
  check("run.decisions=2e6");
}

TEST(Options, PresetsAreValidAndAnUnknownOneIsNamed) {
  for (const char* preset : {"paper", "shaping", "stride", "demo"}) {
    training::TrainOptions options;
    training::read_toml(training::preset_file(preset), options);
    options.check();
  }
  EXPECT_ERROR(training::preset_file("fast"),
               "preset 'fast': must be one of demo, paper, shaping, stride");
}

}  // namespace
}  // namespace stride
