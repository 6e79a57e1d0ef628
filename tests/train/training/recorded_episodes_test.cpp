// Potential-based shaping of whole episodes of the runner, as training has recorded them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "calibrate/osim/model.h"
#include "tests/support/temporary_folder.h"
#include "train/environment/runner_environment.h"
#include "train/training/checkpoint.h"
#include "train/training/train.h"

namespace stride {
namespace {

training::TrainOptions acting_at_random() {
  training::TrainOptions options;
  options.run.decisions = 1500;
  options.run.environments = 4;
  options.run.warm_up = 1'000'000;  // it never learns
  options.run.evaluate_every = 1500;
  options.run.precision = "double";
  options.environment.reference_share = 0;
  options.exploration.parameter_share = 0;
  return options;
}

/// F of decisions as samples of training hold it, by round, environment and mirrored or not.
using Shaping = std::map<std::tuple<std::int64_t, int, bool>, double>;

Shaping sampled_shaping(const ddpg::ReplayBuffer<double>& buffer,
                        const training::TrainOptions& options) {
  Random random(5);
  ddpg::Batch<double> batch;
  Shaping shaping;
  for (int i = 0; i < 50; ++i) {
    buffer.sample({.batch = 2000,
                   .gamma = options.agent.gamma,
                   .reward_scale = options.reward.scale,
                   .shaped = true},
                  random, batch);
    for (std::size_t s = 0; s < batch.draws.size(); ++s) {
      const auto& [round, environment, mirrored] = batch.draws[s];
      shaping[{round, environment, mirrored}] =
          batch.rewards[static_cast<Eigen::Index>(s)] -
          options.reward.scale * buffer.record(round, environment).reward;
    }
  }
  return shaping;
}

TEST(RecordedEpisodes, ShapingTelescopesUnderRepeatMirrorFallsAndTimeLimits) {
  const TemporaryFolder folder;
  const auto model = osim::load_osim(osim::default_model_file());
  environment::RunnerOptions brief;
  brief.max_steps = 117;
  const training::EnvironmentFactory runners = [&](int) {
    return std::make_unique<environment::RunnerEnvironment>(model, brief);
  };
  training::Demonstration human;
  human.potential = load_potential(STRIDE_SOURCE_DIR "/train/results/human.potential.json");
  training::TrainOptions options = acting_at_random();
  training::make_run_folder(options, human, folder / "run");
  const std::atomic<bool> stop = false;
  training::train(folder / "run", runners, stop, nullptr);

  options = training::load_run_options(folder / "run");
  const Potential potential = *training::load_run_demonstration(options, folder / "run").potential;
  auto training = training::start_training<double>(options, &potential, runners);
  training::load_checkpoint(training, folder / "run");
  const ddpg::ReplayBuffer<double>& buffer = training.buffer;
  const Shaping shaping = sampled_shaping(buffer, options);

  std::map<ddpg::RecordKind, int> ends;
  for (int e = 0; e < options.run.environments; ++e) {
    std::int64_t start = 0;
    for (std::int64_t round = 0; round + 1 < buffer.rounds(); ++round) {
      const ddpg::RecordKind outcome = buffer.record(round, e).outcome;
      if (outcome == ddpg::RecordKind::ended) start = round + 1;
      if (outcome != ddpg::RecordKind::terminated && outcome != ddpg::RecordKind::truncated)
        continue;
      ++ends[outcome];
      const auto phi = [&](std::int64_t of, bool mirrored) {
        const auto& record = buffer.record(of, e);
        const double time_s = 0.03 * static_cast<double>(of - start);
        const double phase = potential.phase_at(time_s);
        EXPECT_NEAR(std::remainder(record.phase - phase, 1), 0, 1e-12);
        const Pose& pose = record.pose;
        return mirrored ? potential(pose.mirrored(), phase + 0.5) : potential(pose, phase);
      };
      for (const bool mirrored : {false, true}) {
        double sum = 0, gamma_power = 1;
        for (std::int64_t t = start; t <= round; ++t, gamma_power *= options.agent.gamma)
          sum += gamma_power * shaping.at({t, e, mirrored});
        const double last = outcome == ddpg::RecordKind::terminated ? 0 : phi(round + 1, mirrored);
        EXPECT_NEAR(sum, gamma_power * last - phi(start, mirrored), 1e-10);
      }
    }
  }
  EXPECT_GT(ends[ddpg::RecordKind::terminated], 3);
  EXPECT_GT(ends[ddpg::RecordKind::truncated], 3);
}

}  // namespace
}  // namespace stride
