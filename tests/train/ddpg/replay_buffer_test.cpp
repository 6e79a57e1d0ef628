#include "train/ddpg/replay_buffer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "shaping/shaping_reward.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

constexpr int kEnvironments = 3;

environment::Mirror feature_mirror() {
  return environment::mirror_by_name({"id", "knee_r", "knee_l"});
}
environment::Mirror action_mirror() { return environment::mirror_by_name({"push_r", "push_l"}); }

/// Episodes of random length in each environment, added as by the training loop. Feature 0
/// identifies the record.
ddpg::ReplayBuffer<double> filled(std::int64_t rounds, std::int64_t capacity, Random& random) {
  ddpg::ReplayBuffer<double> buffer(
      {.features = 3, .actions = 2, .environments = kEnvironments, .capacity = capacity, .lead = 1},
      feature_mirror(), action_mirror());
  std::vector<bool> over(kEnvironments);
  for (std::int64_t round = 0; round < rounds; ++round) {
    for (int e = 0; e < kEnvironments; ++e) {
      auto& record = buffer.record(round, e);
      record = {};
      record.reward = normal(random);
      record.phase = uniform(random);
      record.phi = 10 * uniform(random);
      record.phi_mirrored = 10 * uniform(random);
      const double kind = uniform(random);
      record.outcome = over[e]      ? ddpg::RecordKind::ended
                       : kind < 0.1 ? ddpg::RecordKind::terminated
                       : kind < 0.2 ? ddpg::RecordKind::truncated
                                    : ddpg::RecordKind::continued;
      over[e] = record.outcome == ddpg::RecordKind::terminated ||
                record.outcome == ddpg::RecordKind::truncated;
      buffer.features(round, e) << static_cast<double>(round * kEnvironments + e), 1, 2;
      buffer.action(round, e) << 0.25, 0.75;
    }
    buffer.publish(1);
  }
  return buffer;
}

/// The expected sample, directly from the definition.
struct Expected {
  double reward = 0, discount = 1;
  std::int64_t last = 0;
};

Expected expected(const ddpg::ReplayBuffer<double>& buffer, std::int64_t round, int e,
                  const ddpg::SampleOptions& options, bool mirrored) {
  const auto phi = [&](std::int64_t r) {
    const auto& record = buffer.record(r, e);
    return mirrored ? record.phi_mirrored : record.phi;
  };
  Expected x;
  double gamma_power = 1;
  for (int i = 0; i < options.n_step; ++i) {
    const auto& record = buffer.record(round, e);
    const bool fell = record.outcome == ddpg::RecordKind::terminated;
    x.reward += gamma_power * options.reward_scale * record.reward;
    if (options.shaped)
      x.reward += gamma_power * shaping_reward(phi(round), phi(round + 1),
                                               options.discounted ? options.gamma : 1, fell);
    gamma_power *= options.gamma;
    ++round;
    x.discount = fell ? 0 : gamma_power;
    if (record.outcome != ddpg::RecordKind::continued || round + 1 == buffer.rounds()) break;
  }
  x.last = round;
  return x;
}

TEST(ReplayBuffer, SamplesAreTheirDefinitionOverSeveralStepsWithShapingFallsAndTimeLimits) {
  Random random(11);
  const ddpg::ReplayBuffer<double> buffer = filled(200, 100'000, random);
  for (const int n_step : {1, 3, 7})
    for (const auto& [shaped, discounted] :
         {std::pair{false, true}, std::pair{true, true}, std::pair{true, false}}) {
      const ddpg::SampleOptions options{.batch = 2000,
                                        .n_step = n_step,
                                        .gamma = 0.93,
                                        .reward_scale = 10,
                                        .shaped = shaped,
                                        .discounted = discounted,
                                        .mirror = true};
      ddpg::Batch<double> batch;
      buffer.sample(options, random, batch);
      int mirrored_count = 0;
      for (int s = 0; s < options.batch; ++s) {
        const auto id = static_cast<std::int64_t>(batch.states(0, s));
        const int e = static_cast<int>(id % kEnvironments);
        const bool mirrored = batch.states(1, s) == 2;
        mirrored_count += mirrored;
        const Expected x = expected(buffer, id / kEnvironments, e, options, mirrored);
        ASSERT_NEAR(batch.rewards[s], x.reward, 1e-10);
        ASSERT_NEAR(batch.discounts[s], x.discount, 1e-14);
        ASSERT_EQ(batch.next_states(0, s), static_cast<double>(x.last * kEnvironments + e));
        ASSERT_EQ(batch.actions(0, s), mirrored ? 0.75 : 0.25);
        ASSERT_EQ(batch.next_states(2, s), mirrored ? 1 : 2);
      }
      EXPECT_NEAR(mirrored_count, 1000, 120);
    }
}

TEST(ReplayBuffer, SamplesUniformly) {
  Random random(21);
  const ddpg::ReplayBuffer<double> buffer = filled(60, 90, random);  // 30 rounds are kept
  std::map<std::int64_t, int> counts;
  for (std::int64_t round = buffer.first_round(); round + 1 < buffer.rounds(); ++round)
    for (int e = 0; e < kEnvironments; ++e)
      if (buffer.record(round, e).outcome != ddpg::RecordKind::ended)
        counts[round * kEnvironments + e] = 0;
  ddpg::Batch<double> batch;
  constexpr int kDraws = 100'000;
  buffer.sample({.batch = kDraws}, random, batch);
  for (int s = 0; s < kDraws; ++s) {
    const auto found = counts.find(static_cast<std::int64_t>(batch.states(0, s)));
    ASSERT_NE(found, counts.end()) << "a record that may not be sampled";
    ++found->second;
  }
  const double mean = static_cast<double>(kDraws) / static_cast<double>(counts.size());
  double chi_squared = 0;
  for (const auto& [id, n] : counts) chi_squared += (n - mean) * (n - mean) / mean;
  // χ² of k degrees of freedom is about normal (k, 2k): five standard deviations.
  const double k = static_cast<double>(counts.size()) - 1;
  EXPECT_NEAR(chi_squared, k, 5 * std::sqrt(2 * k));
}

TEST(ReplayBuffer, RoundsWrittenAheadLeaveWhatIsSampledAlone) {
  Random random(31);
  ddpg::ReplayBuffer<double> buffer = filled(50, 60, random);
  const std::int64_t first = buffer.first_round();
  for (int e = 0; e < kEnvironments; ++e) buffer.features(buffer.rounds(), e).setConstant(-1);
  for (std::int64_t round = first; round < buffer.rounds(); ++round)
    for (int e = 0; e < kEnvironments; ++e)
      EXPECT_EQ(buffer.features(round, e)[0], static_cast<double>(round * kEnvironments + e));
}

TEST(ReplayBuffer, MirroredShapingIsThatOfTheMirroredPoseHalfAStrideLater) {
  Random random(41);
  Potential potential;
  potential.period_s = 0.7;
  for (int k = 0; k < 8; ++k) {
    Keyframe key;
    key.phase = k / 8.0;
    key.pose.pelvis_height_m() = 0.9 + 0.02 * normal(random);
    for (const auto part : {PosePart::knee_r, PosePart::foot_r, PosePart::knee_l, PosePart::foot_l})
      for (double& each : key.pose.numbers(part)) each = -0.3 + 0.2 * normal(random);
    potential.keyframes.push_back(key);
  }
  ddpg::ReplayBuffer<double> buffer = filled(20, 1000, random);
  for (std::int64_t round = 0; round < 20; ++round)
    for (int e = 0; e < kEnvironments; ++e) {
      Pose pose = potential.target(uniform(random));
      pose[PosePart::knee_r].x() += 0.1;
      buffer.record(round, e).pose = pose;
    }
  buffer.set_potential(potential);
  for (std::int64_t round = 0; round < 20; ++round)
    for (int e = 0; e < kEnvironments; ++e) {
      const auto& record = buffer.record(round, e);
      const Pose& pose = record.pose;
      EXPECT_EQ(record.phi, potential(pose, record.phase));
      EXPECT_EQ(record.phi_mirrored, potential(pose.mirrored(), record.phase + 0.5));
    }
  // With a symmetric gait the mirror image is worth the same.
  for (int k = 0; k < 4; ++k)
    potential.keyframes[k + 4].pose = potential.keyframes[k].pose.mirrored();
  buffer.set_potential(potential);
  for (int e = 0; e < kEnvironments; ++e)
    EXPECT_NEAR(buffer.record(3, e).phi, buffer.record(3, e).phi_mirrored, 1e-10);
}

TEST(ReplayBuffer, TooSmallACapacityIsNamed) {
  Random random(1);
  EXPECT_ERROR(filled(1, 4, random), "replay.capacity = 4");
}

}  // namespace
}  // namespace stride
