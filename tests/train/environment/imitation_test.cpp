#include "train/environment/imitation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/throws.h"
#include "train/environment/runner_environment.h"

namespace stride {
namespace {

constexpr double kClipPeriod_s = 0.8, kClipStep_s = 0.01;

/// Coordinate k of a clip at `phase`, and its rate.
double angle(int k, double phase) {
  return 0.1 * k + 0.4 * std::sin(2 * std::numbers::pi * (phase + 0.13 * k));
}
double rate(int k, double phase) {
  return 0.4 * 2 * std::numbers::pi / kClipPeriod_s *
         std::cos(2 * std::numbers::pi * (phase + 0.13 * k));
}

CalibratedTrajectory clip_of(const std::string& movement, double duration_s) {
  CalibratedTrajectory clip;
  clip.source = "clip.mp4";
  clip.movement = movement;
  clip.period_s = kClipPeriod_s;
  for (int i = 0; i * kClipStep_s < duration_s; ++i) {
    CalibratedSample sample;
    sample.time_s = kClipStep_s * i;
    sample.phase = std::fmod(sample.time_s / kClipPeriod_s, 1);
    for (int k = 0; k < simulation::kCoordinates; ++k)
      sample.coordinates[k] = angle(k, sample.phase);
    sample.coordinates[simulation::kPelvisX] = sample.time_s;
    sample.coordinates[simulation::kPelvisY] = 0.95;
    clip.samples.push_back(sample);
  }
  return clip;
}

simulation::RunnerState of_clip(double phase) {
  simulation::RunnerState state;
  for (int k = 0; k < simulation::kCoordinates; ++k) {
    state.q[k] = angle(k, phase);
    state.u[k] = rate(k, phase);
  }
  return state;
}

TEST(ImitationOf, TheClipsOwnMotionIsTheMostLike) {
  const environment::Imitation imitation(clip_of("walk", 3 * kClipPeriod_s), {.reward_per_s = 2});
  for (double phase = 0; phase < 1; phase += 0.013) {
    const simulation::RunnerState own = of_clip(phase);
    const double best = imitation.similarity(own, phase);
    EXPECT_GT(best, 0.998) << phase;
    EXPECT_LE(best, 1) << phase;
    EXPECT_NEAR(imitation.reward(own, phase, kClipStep_s), 2 * kClipStep_s * best, 1e-15);
    EXPECT_LT(imitation.similarity(own, phase + 0.1), best) << "at another time";
    for (int k = 0; k < simulation::kCoordinates; ++k) {
      if (k == simulation::kPelvisX || k == simulation::kPelvisY) continue;
      for (const double off : {-0.3, 0.3}) {
        simulation::RunnerState other = own;
        other.q[k] += off;
        EXPECT_LT(imitation.similarity(other, phase), best - 0.05);
        other = own;
        other.u[k] += 10 * off;
        EXPECT_LT(imitation.similarity(other, phase), best - 0.01);
      }
    }
  }
}

TEST(ImitationOf, WhereverItWalksAndHoweverHighItIsTheSame) {
  const environment::Imitation imitation(clip_of("walk", kClipPeriod_s), {.reward_per_s = 1});
  simulation::RunnerState state = of_clip(0.3);
  const double similarity = imitation.similarity(state, 0.3);
  state.q[simulation::kPelvisX] = 100;
  state.q[simulation::kPelvisY] = 0.7;
  EXPECT_EQ(imitation.similarity(state, 0.3), similarity);
}

TEST(ImitationOf, ADifferenceOfTheWidthLeavesOneOverE) {
  const environment::Imitation imitation(clip_of("walk", kClipPeriod_s),
                                         {.reward_per_s = 1, .angle_deg = 20});
  simulation::RunnerState state = of_clip(0.3);
  for (double& q : state.q) q += 20 * std::numbers::pi / 180;
  EXPECT_NEAR(imitation.similarity(state, 0.3), 0.8 / std::numbers::e + 0.2, 2e-3);
}

TEST(ImitationOf, AMovementThatDoesNotRepeatStandsStillBeforeAndAfter) {
  const environment::Imitation imitation(clip_of("jump", kClipPeriod_s), {.reward_per_s = 1});
  EXPECT_EQ(imitation.phase_at(0.5, 3), 1);
  EXPECT_NEAR(imitation.phase_at(0.5, 0.1 * kClipPeriod_s), 0.6, 1e-12);
  simulation::RunnerState end = of_clip(1 - kClipStep_s / kClipPeriod_s);
  EXPECT_LT(imitation.similarity(end, 1), 0.99);
  end.u.fill(0);
  EXPECT_NEAR(imitation.similarity(end, 1), 1, 1e-12);
  const environment::Imitation strides(clip_of("walk", kClipPeriod_s), {.reward_per_s = 1});
  EXPECT_NEAR(strides.phase_at(0.5, 0.75 * kClipPeriod_s), 0.25, 1e-12);
}

TEST(ImitationOf, WhatCannotBeImitatedIsNamed) {
  CalibratedTrajectory clip = clip_of("walk", kClipPeriod_s);
  clip.period_s = CalibratedTrajectory::kUnknown;
  EXPECT_ERROR(environment::Imitation(clip, {}), "clip.mp4: its period is not known");
  EXPECT_ERROR(environment::Imitation(clip_of("walk", 0.02), {}), "clip.mp4: too short");
  const osim::Model model = osim::load_osim(osim::default_model_file());
  environment::RunnerOptions options;
  options.imitation.reward_per_s = 1;
  EXPECT_ERROR(environment::RunnerEnvironment(model, options),
               "imitation.reward_per_s = 1: needs the clip's run");
}

/// A clip of standing, which a runner without excitations leaves by falling.
CalibratedTrajectory standing(const osim::Model& model) {
  CalibratedTrajectory clip = clip_of("walk", kClipPeriod_s);
  for (CalibratedSample& sample : clip.samples)
    sample.coordinates = simulation::default_state(model).q;
  return clip;
}

TEST(ImitatingRunner, IsPaidForEachStepOnTopOfTheTaskAndItsEpisodeEndsFarFromTheClip) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  environment::RunnerOptions options;
  options.reference = standing(model);
  environment::RunnerEnvironment plain(model, options);
  options.imitation = {.reward_per_s = 2};
  environment::RunnerEnvironment imitating(model, options);
  options.imitation.end_deg = 15;
  environment::RunnerEnvironment ending(model, options);
  const environment::Imitation imitation(*options.reference, options.imitation);
  for (environment::RunnerEnvironment* each : {&plain, &imitating, &ending}) each->reset(4);
  const Eigen::VectorXd relaxed = Eigen::VectorXd::Zero(simulation::kMuscles);
  for (bool ended = false; !ended;) {
    const environment::Step& before = plain.step(relaxed);
    const environment::Step& step = imitating.step(relaxed);
    const simulation::RunnerState& state = imitating.engine().state();
    EXPECT_NEAR(step.reward - before.reward, imitation.reward(state, 0, kClipStep_s), 1e-12);
    ASSERT_FALSE(step.terminated) << "it fell before it was far from the clip";
    ended = ending.step(relaxed).terminated;
    EXPECT_EQ(ended, imitation.ends(state, 0));
  }
  EXPECT_EQ(imitating.distance_m(), plain.distance_m());
}

}  // namespace
}  // namespace stride
