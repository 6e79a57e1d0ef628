#include "train/training/train.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>

#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"
#include "tests/train/support/killed_at_random_moments.h"
#include "tests/train/support/point_mass.h"
#include "train/training/checkpoint.h"
#include "train/training/curve.h"

namespace stride {
namespace {

namespace fs = std::filesystem;

training::TrainOptions small_run() {
  training::TrainOptions options;
  options.run.decisions = 3000;
  options.run.environments = 4;
  options.run.round = 3;
  options.run.action_repeat = 1;
  options.run.warm_up = 200;
  options.run.updates_per_decision = 0.5;
  options.run.evaluate_every = 500;
  options.run.evaluation_episodes = 3;
  options.run.threads = 1;
  options.observation = {.centre = false, .derived = false, .activations = false};
  options.agent.actor_hidden = options.agent.critic_hidden = {16, 16};
  options.agent.batch = 32;
  options.agent.gamma = 0.95;
  options.agent.actor_rate = 1e-3;
  options.agent.tau = 0.01;
  options.exploration.decay_decisions = 2000;
  options.replay.capacity = 1500;
  options.shaping.scale = 1;
  return options;
}

std::string trained(const training::TrainOptions& options,
                    const training::Demonstration& demonstration, const fs::path& run) {
  training::make_run_folder(options, demonstration, run);
  const std::atomic<bool> stop = false;
  training::train(run, point_mass, stop, nullptr);
  return read_file(run / "curve.csv");
}

TEST(Train, SolvesAPointMassInSeconds) {
  TemporaryFolder folder;
  training::TrainOptions options = small_run();
  options.run.decisions = 40000;
  options.run.evaluation_episodes = 10;
  options.replay.capacity = 40000;
  trained(options, {}, folder / "run");
  const Table curve = load_table(folder / "run" / "curve.csv", "curve", 1);
  const auto distance = curve.column("evaluation_distance_m");
  EXPECT_LT(curve.rows.front()[distance], -0.2) << "it can do it untrained";
  EXPECT_GT(curve.rows.back()[distance], -0.08) << "it does not come to the goal";
  EXPECT_EQ(curve.rows.back()[curve.column("evaluation_falls")], 0);
}

TEST(Train, CurveDependsOnTheSeedAloneNotOnThreads) {
  TemporaryFolder folder;
  const Potential potential = point_mass_potential();
  training::TrainOptions options = small_run();
  const std::string curve =
      trained(options, {.potential = potential, .reference = {}}, folder / "a");
  options.run.threads = 3;
  EXPECT_EQ(trained(options, {.potential = potential, .reference = {}}, folder / "b"), curve);
  options.run.seed = 2;
  EXPECT_NE(trained(options, {.potential = potential, .reference = {}}, folder / "c"), curve);
}

TEST(Train, KilledAnywhereAndResumedItGivesTheCurveOfAnUninterruptedRun) {
  TemporaryFolder folder;
  const Potential potential = point_mass_potential();
  training::TrainOptions options = small_run();
  options.run.decisions = 15000;
  options.run.checkpoint_s = 0.01;
  const auto begin = std::chrono::steady_clock::now();
  const std::string uninterrupted =
      trained(options, {.potential = potential, .reference = {}}, folder / "a");
  const auto duration = std::chrono::steady_clock::now() - begin;
  training::make_run_folder(options, {.potential = potential, .reference = {}}, folder / "b");
  const int kills = killed_at_random_moments(
      [&] {
        const std::atomic<bool> stop = false;
        training::train(folder / "b", point_mass, stop, nullptr);
      },
      duration);
  EXPECT_GT(kills, 3) << "the run is too short for this test";
  const std::atomic<bool> stop = false;
  const training::TrainSummary summary = training::train(folder / "b", point_mass, stop, nullptr);
  EXPECT_TRUE(summary.finished);
  EXPECT_EQ(read_file(folder / "b" / "curve.csv"), uninterrupted);
  EXPECT_EQ(read_file(folder / "b" / "agent.safetensors"),
            read_file(folder / "a" / "agent.safetensors"));
}

TEST(Train, ContinuedWithMoreDecisionsItGivesTheCurveOfALongerRun) {
  TemporaryFolder folder;
  training::TrainOptions options = small_run();
  const std::string longer = trained(options, {}, folder / "a");
  options.run.decisions = 1700;
  trained(options, {}, folder / "b");
  options.run.decisions = 3000;
  write_file_atomically(folder / "b" / "config.toml", training::to_toml(options, ""));
  const std::atomic<bool> stop = false;
  training::train(folder / "b", point_mass, stop, nullptr);
  EXPECT_EQ(read_file(folder / "b" / "curve.csv"), longer);
}

TEST(Train, StoppedItKeepsACheckpointAndContinues) {
  TemporaryFolder folder;
  const training::TrainOptions options = small_run();
  const std::string uninterrupted = trained(options, {}, folder / "a");
  training::make_run_folder(options, {}, folder / "b");
  std::atomic<bool> stop = true;
  EXPECT_FALSE(training::train(folder / "b", point_mass, stop, nullptr).finished);
  EXPECT_TRUE(fs::exists(training::checkpoint_file(folder / "b")));
  stop = false;
  EXPECT_TRUE(training::train(folder / "b", point_mass, stop, nullptr).finished);
  EXPECT_EQ(read_file(folder / "b" / "curve.csv"), uninterrupted);
}

/// Runs in a child process whose files cannot grow beyond `bytes`. Returns whether it ended and
/// reported that it could not save.
bool trains_on_a_full_disk(const fs::path& run, rlim_t bytes) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::atomic<bool> stop = false;
    const training::TrainSummary summary = training::train(run, point_mass, stop, nullptr);
    ::_exit(summary.finished && summary.unsaved.find("cannot be written") != std::string::npos ? 0
                                                                                               : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(Train, AFullDiskIsSurvivedAndTheRunContinuesFromTheCheckpointBefore) {
  TemporaryFolder folder;
  training::TrainOptions options = small_run();
  options.run.checkpoint_s = 0.01;
  const std::string uninterrupted = trained(options, {}, folder / "a");
  options.run.decisions = 1000;
  trained(options, {}, folder / "b");
  const auto checkpoint = fs::last_write_time(training::checkpoint_file(folder / "b"));
  options.run.decisions = 3000;
  training::write_run_options(options, folder / "b");
  EXPECT_TRUE(trains_on_a_full_disk(folder / "b", 12'000));
  EXPECT_EQ(fs::last_write_time(training::checkpoint_file(folder / "b")), checkpoint);
  for (const auto& entry : fs::recursive_directory_iterator(folder / "b"))
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
  const std::atomic<bool> stop = false;
  const training::TrainSummary summary = training::train(folder / "b", point_mass, stop, nullptr);
  EXPECT_TRUE(summary.finished);
  EXPECT_EQ(summary.unsaved, "");
  EXPECT_EQ(read_file(folder / "b" / "curve.csv"), uninterrupted);
}

TEST(Train, WhatAKillLeftHalfWrittenIsRemoved) {
  TemporaryFolder folder;
  trained(small_run(), {}, folder / "run");
  const fs::path left[] = {
      folder / "run" / "checkpoint.safetensors.tmp123",
      folder / "run" / "replay" / "000000000001-000000000002.safetensors.tmp9"};
  for (const fs::path& file : left) std::ofstream(file) << "half";
  const std::atomic<bool> stop = false;
  training::train(folder / "run", point_mass, stop, nullptr);
  for (const fs::path& file : left) EXPECT_FALSE(fs::exists(file)) << file;
}

TEST(Train, DivergenceIsNamedAndTheLastCheckpointStays) {
  TemporaryFolder folder;
  training::TrainOptions options = small_run();
  options.run.checkpoint_s = 0.01;
  options.reward.scale = 1e9;
  options.agent.critic_rate = 1;
  options.agent.layer_norm = false;
  training::make_run_folder(options, {}, folder / "run");
  const std::atomic<bool> stop = false;
  const training::TrainSummary summary = training::train(folder / "run", point_mass, stop, nullptr);
  EXPECT_THAT(summary.divergence, ::testing::HasSubstr("learning diverged at update"));
  EXPECT_THAT(summary.divergence, ::testing::HasSubstr("lower agent.critic_rate"));
}

TEST(Train, ReplayOnDiskDoesNotGrowBeyondItsCapacity) {
  TemporaryFolder folder;
  training::TrainOptions options = small_run();
  options.run.checkpoint_s = 0.01;
  options.replay.capacity = 400;
  trained(options, {}, folder / "run");
  std::int64_t rounds = 0;
  for (const auto& entry : fs::directory_iterator(folder / "run" / "replay")) {
    long long from = 0, to = 0;
    ASSERT_EQ(std::sscanf(entry.path().filename().c_str(), "%lld-%lld", &from, &to), 2);
    rounds += to - from;
  }
  EXPECT_GE(rounds * options.run.environments, 400);
  EXPECT_LE(rounds * options.run.environments, 1600);
}

TEST(Train, DamagedCheckpointsAreRefusedWithTheirName) {
  TemporaryFolder folder;
  trained(small_run(), {}, folder / "run");
  const fs::path file = training::checkpoint_file(folder / "run");
  const std::string content = read_file(file);
  const std::atomic<bool> stop = false;
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{5}, std::size_t{100}, content.size() / 2, content.size() - 1}) {
    write_file_atomically(file, content.substr(0, size));
    EXPECT_ERROR(training::train(folder / "run", point_mass, stop, nullptr),
                 "checkpoint.safetensors");
  }
  write_file_atomically(file, content);
  fs::remove(fs::directory_iterator(folder / "run" / "replay")->path());
  EXPECT_ERROR(training::train(folder / "run", point_mass, stop, nullptr), "missing");
}

TEST(Train, AFolderThatHoldsARunIsNotOverwritten) {
  TemporaryFolder folder;
  training::make_run_folder(small_run(), {}, folder / "run");
  EXPECT_ERROR(training::make_run_folder(small_run(), {}, folder / "run"), "--resume");
}

}  // namespace
}  // namespace stride
