#include "train/ppo/train.h"

#include <gtest/gtest.h>

#include <chrono>

#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"
#include "tests/train/support/killed_at_random_moments.h"
#include "tests/train/support/point_mass.h"
#include "train/ppo/slot.h"
#include "train/training/curve.h"

namespace stride::ppo {
namespace {

namespace fs = std::filesystem;

training::TrainOptions small_run() {
  training::TrainOptions options;
  options.run.learner = "ppo";
  options.run.decisions = 4000;
  options.run.environments = 10;
  options.run.action_repeat = 1;
  options.run.evaluate_every = 1000;
  options.run.evaluation_episodes = 3;
  options.run.threads = 1;
  options.observation = {.centre = false, .derived = false, .activations = false};
  options.ppo.actor_hidden = options.ppo.critic_hidden = {16};
  options.ppo.horizon = 40;
  options.ppo.minibatch = 100;
  options.ppo.gamma = 0.95;
  options.ppo.mirror = false;  // there is no hip
  options.ppo.alive_per_s = options.ppo.final_alive_per_s = 0;
  options.shaping.scale = 1;
  return options;
}

std::string trained(const training::TrainOptions& options,
                    const training::Demonstration& demonstration, const fs::path& run) {
  training::make_run_folder(options, demonstration, run);
  const std::atomic<bool> stop = false;
  ppo::train(run, point_mass, stop, nullptr);
  return read_file(run / "curve.csv");
}

TEST(PpoTrain, BringsAPointMassToRest) {
  TemporaryFolder folder;
  training::TrainOptions options = small_run();
  options.run.decisions = 60000;
  options.run.evaluation_episodes = 10;
  trained(options, {}, folder / "run");
  const Table curve = load_table(folder / "run" / "curve.csv", "curve", 1);
  const auto reward = curve.column("evaluation_reward");
  EXPECT_LT(curve.rows.front()[reward], -0.5) << "it can do it untrained";
  EXPECT_GT(curve.rows.back()[reward], -0.35) << "it does not come to the goal";
  EXPECT_EQ(curve.rows.back()[curve.column("evaluation_falls")], 0);
}

TEST(PpoTrain, CurveDependsOnTheSeedAloneNotOnThreads) {
  TemporaryFolder folder;
  const training::Demonstration demonstration{.potential = point_mass_potential(), .reference = {}};
  training::TrainOptions options = small_run();
  const std::string curve = trained(options, demonstration, folder / "a");
  options.run.threads = 3;
  EXPECT_EQ(trained(options, demonstration, folder / "b"), curve);
  options.run.seed = 2;
  EXPECT_NE(trained(options, demonstration, folder / "c"), curve);
}

TEST(PpoTrain, KilledAnywhereAndResumedItGivesTheCurveOfAnUninterruptedRun) {
  TemporaryFolder folder;
  const training::Demonstration demonstration{.potential = point_mass_potential(), .reference = {}};
  training::TrainOptions options = small_run();
  options.run.decisions = 20000;
  options.run.checkpoint_s = 0.01;
  const auto begin = std::chrono::steady_clock::now();
  const std::string uninterrupted = trained(options, demonstration, folder / "a");
  const auto duration = std::chrono::steady_clock::now() - begin;
  training::make_run_folder(options, demonstration, folder / "b");
  const int kills = killed_at_random_moments(
      [&] {
        const std::atomic<bool> stop = false;
        ppo::train(folder / "b", point_mass, stop, nullptr);
      },
      duration);
  EXPECT_GT(kills, 3) << "the run is too short for this test";
  const std::atomic<bool> stop = false;
  EXPECT_TRUE(ppo::train(folder / "b", point_mass, stop, nullptr).finished);
  EXPECT_EQ(read_file(folder / "b" / "curve.csv"), uninterrupted);
  EXPECT_EQ(read_file(folder / "b" / "agent.safetensors"),
            read_file(folder / "a" / "agent.safetensors"));
}

TEST(PpoTrain, BeginsWithTheNetworksOfAnotherRun) {
  TemporaryFolder folder;
  training::TrainOptions options = small_run();
  trained(options, {}, folder / "first");
  options.run.seed = 7;
  options.ppo.start = "start.safetensors";
  training::make_run_folder(options, {}, folder / "second");
  fs::copy_file(folder / "first" / "checkpoint.safetensors", folder / "second" / options.ppo.start);
  const std::atomic<bool> stop = false;
  ppo::train(folder / "second", point_mass, stop, nullptr);
  const Table first = load_table(folder / "first" / "curve.csv", "curve", 1),
              second = load_table(folder / "second" / "curve.csv", "curve", 1);
  const auto reward = first.column("evaluation_reward"), decisions = first.column("decisions");
  EXPECT_EQ(second.rows.front()[reward], first.rows.back()[reward]);
  EXPECT_NE(second.rows.back()[reward], first.rows.back()[reward]);
  EXPECT_EQ(second.rows.front()[decisions], 0);

  options.ppo.actor_hidden = {17};
  training::make_run_folder(options, {}, folder / "other");
  fs::copy_file(folder / "first" / "checkpoint.safetensors", folder / "other" / options.ppo.start);
  EXPECT_ERROR(ppo::train(folder / "other", point_mass, stop, nullptr), "start.safetensors");
}

/// Σ γᵗ F over whole episodes with repeated actions: −Φ(s₀) where it fell, γᵀ Φ(s_T) − Φ(s₀) at the
/// time limit.
TEST(PpoSlot, ShapingTelescopesOverAnEpisode) {
  const Potential potential = point_mass_potential();
  const double gamma = 0.9;
  const environment::Observer observer(
      PointMass().spec(), {.centre = false, .derived = false, .activations = false}, 0.1);
  const auto make = [&](const Potential* shaping) {
    return Slot(std::make_unique<PointMass>(), observer,
                {.action_repeat = 2, .gamma = gamma, .potential = shaping}, 3);
  };
  Slot plain = make(nullptr), shaped = make(&potential);
  PointMass twin;  // the same episode: its poses
  int falls = 0, limits = 0;
  Vector action(1);
  for (int episode = 0; episode < 40; ++episode) {
    plain.features(), shaped.features();
    twin.reset(plain.state().episode_seed);
    ASSERT_EQ(plain.state().episode_seed, shaped.state().episode_seed);
    const double first = potential(twin.pose(), 0);
    const Vector logits = Vector::Constant(1, episode % 2 == 0 ? 0.0f : 5.0f);
    double sum = 0, factor = 1;
    EpisodeEnd end = EpisodeEnd::none;
    while (end == EpisodeEnd::none) {
      const auto with = shaped.decide(logits, 0, action);
      const auto without = plain.decide(logits, 0, action);
      end = with.end;
      sum += factor * (static_cast<double>(with.reward) - static_cast<double>(without.reward));
      factor *= gamma;
      for (int i = 0; i < 2; ++i)
        if (const environment::Step& step = twin.step(action.cast<double>()); step.terminated)
          break;
    }
    const double last = end == EpisodeEnd::terminated
                            ? 0
                            : factor * potential(twin.pose(), potential.phase_at(twin.time_s()));
    EXPECT_NEAR(sum, last - first, 1e-5);
    ++(end == EpisodeEnd::terminated ? falls : limits);
    plain.begin_next(), shaped.begin_next();
  }
  EXPECT_GT(falls, 3);
  EXPECT_GT(limits, 3);
}

}  // namespace
}  // namespace stride::ppo
