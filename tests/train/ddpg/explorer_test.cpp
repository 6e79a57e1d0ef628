#include "train/ddpg/explorer.h"

#include <gtest/gtest.h>

#include "shaping/shaping_reward.h"
#include "tests/train/support/point_mass.h"

namespace stride {
namespace {

Potential some_potential() {
  Potential potential = point_mass_potential();
  potential.period_s = 0.37;
  potential.weight = 0.3;
  return potential;
}

network::Policy<double> point_mass_policy() {
  Random random(4);
  network::Policy<double> policy{
      .actor = network::Mlp<double>({.inputs = 4,
                                     .outputs = 1,
                                     .hidden = {8},
                                     .activation = network::Activation::tanh,
                                     .output = network::Activation::sigmoid,
                                     .layer_norm = true}),
      .normaliser =
          network::Normaliser(environment::mirror_by_name({"x", "v", "phase_sin", "phase_cos"})),
      .sigma = 0.4};
  policy.actor.initialise(random, 1);
  return policy;
}

struct Recorded {
  ddpg::ReplayBuffer<double> buffer;
  std::vector<network::EpisodeSummary> episodes;
};

/// Rounds of one environment, whose restart from a stored state halfway (if `restore_at` ≥ 0) must
/// change nothing.
Recorded record(int rounds, const Potential& potential, int action_repeat, int restore_at) {
  const environment::ObservationOptions options{
      .centre = false, .derived = false, .activations = false};
  const environment::Observer observer(PointMass().spec(), options, 0.05 * action_repeat);
  const network::Policy<double> policy = point_mass_policy();
  const ddpg::Explorer<double>::Setup setup{.exploration = {},
                                            .action_repeat = action_repeat,
                                            .sigma_factor = 1,
                                            .potential = &potential};
  const auto make = [&] {
    return ddpg::Explorer<double>(std::make_unique<PointMass>(), observer, setup, 99);
  };
  ddpg::Explorer<double> explorer = make();
  Recorded recorded{ddpg::ReplayBuffer<double>({.features = 4, .actions = 1, .environments = 1},
                                               environment::mirror_by_name(observer.names()),
                                               environment::mirror_by_name({"push"})),
                    {}};
  ddpg::ReplayBuffer<double>& buffer = recorded.buffer;
  for (int round = 0; round < rounds; ++round) {
    if (round == restore_at) {
      const ddpg::ExplorerState<double> state = explorer.state();
      explorer = make();
      explorer.restore(state);
    }
    explorer.decide(policy, buffer, buffer.record(round, 0), buffer.features(round, 0),
                    buffer.action(round, 0));
    buffer.publish(1);
    for (const network::EpisodeSummary& episode : explorer.take_finished())
      recorded.episodes.push_back(episode);
  }
  return recorded;
}

/// Σ γᵗ F_t over whole recorded episodes with repeated actions: −Φ(s₀) where the runner fell,
/// γᵀ Φ(s_T) − Φ(s₀) at the time limit, for the mirror image too.
TEST(Explorer, ShapingTelescopesOverWholeRecordedEpisodes) {
  const Potential potential = some_potential();
  const double gamma = 0.9;
  for (const int repeat : {1, 3}) {
    const Recorded recorded = record(4000, potential, repeat, -1);
    const ddpg::ReplayBuffer<double>& buffer = recorded.buffer;
    int falls = 0, time_limits = 0;
    for (const bool mirrored : {false, true}) {
      const auto phi = [&](std::int64_t round) {
        const auto& r = buffer.record(round, 0);
        const Pose& pose = r.pose;
        const double value =
            mirrored ? potential(pose.mirrored(), r.phase + 0.5) : potential(pose, r.phase);
        EXPECT_EQ(value, mirrored ? r.phi_mirrored : r.phi);
        return value;
      };
      std::int64_t start = 0;
      double sum = 0, power = 1;
      for (std::int64_t round = 0; round + 1 < buffer.rounds(); ++round) {
        const ddpg::RecordKind outcome = buffer.record(round, 0).outcome;
        if (outcome == ddpg::RecordKind::ended) {
          start = round + 1;
          sum = 0;
          power = 1;
          continue;
        }
        const bool fell = outcome == ddpg::RecordKind::terminated;
        sum += power * shaping_reward(phi(round), phi(round + 1), gamma, fell);
        power *= gamma;
        if (outcome == ddpg::RecordKind::continued) continue;
        EXPECT_NEAR(sum, (fell ? 0 : power * phi(round + 1)) - phi(start), 1e-10);
        (fell ? falls : time_limits) += 1;
      }
    }
    EXPECT_GT(falls, 5);
    EXPECT_GT(time_limits, 5);
  }
}

TEST(Explorer, ComparesVelocitiesWhereThePotentialDoes) {
  Potential potential = some_potential();
  potential.velocity_s = 0.1;
  const Recorded recorded = record(200, potential, 3, -1);
  for (std::int64_t round = 0; round < recorded.buffer.rounds(); ++round) {
    const auto& r = recorded.buffer.record(round, 0);
    const double v = recorded.buffer.features(round, 0)[1];
    const MovingPose motion{r.pose, {{v, 0.1 * v, 0, 0, 0, -0.1 * v, 0, 0, 0}}};
    EXPECT_EQ(r.phi, potential(motion, r.phase));
    EXPECT_EQ(r.phi_mirrored, potential(motion.mirrored(), r.phase + 0.5));
  }
}

TEST(Explorer, RecordsStatesInTheirOrderWithTheLastOfAnEpisode) {
  const Potential potential = some_potential();
  const Recorded recorded = record(500, potential, 3, -1);
  const ddpg::ReplayBuffer<double>& buffer = recorded.buffer;
  std::size_t ended = 0;
  for (std::int64_t round = 0; round + 1 < buffer.rounds(); ++round) {
    const auto &now = buffer.record(round, 0), &next = buffer.record(round + 1, 0);
    const bool over =
        now.outcome == ddpg::RecordKind::terminated || now.outcome == ddpg::RecordKind::truncated;
    ASSERT_EQ(next.outcome == ddpg::RecordKind::ended, over);
    ended += over;
    if (now.outcome == ddpg::RecordKind::continued) {
      const double advance = next.phase - now.phase;
      EXPECT_NEAR(advance - std::floor(advance), 0.15 / 0.37, 1e-9);
    }
    if (now.outcome == ddpg::RecordKind::ended) {
      EXPECT_EQ(next.phase, 0);
    }
    // The pose is of the state whose features stand beside it.
    EXPECT_NEAR(now.pose.pelvis_height_m(), 1 + buffer.features(round, 0)[0], 1e-12);
  }
  EXPECT_GE(recorded.episodes.size(), ended);
}

TEST(Explorer, ContinuesFromAStoredStateAsIfNothingHadHappened) {
  const Potential potential = some_potential();
  const Recorded whole = record(300, potential, 3, -1);
  for (const int at : {0, 1, 7, 14, 15, 120}) {
    const Recorded restored = record(300, potential, 3, at);
    for (std::int64_t round = 0; round < 300; ++round) {
      ASSERT_EQ(restored.buffer.record(round, 0).reward, whole.buffer.record(round, 0).reward);
      ASSERT_EQ(restored.buffer.action(round, 0), whole.buffer.action(round, 0));
      ASSERT_EQ(restored.buffer.features(round, 0), whole.buffer.features(round, 0));
    }
    ASSERT_EQ(restored.episodes.size(), whole.episodes.size());
    for (std::size_t i = 0; i < whole.episodes.size(); ++i)
      EXPECT_EQ(restored.episodes[i].reward, whole.episodes[i].reward);
  }
}

}  // namespace
}  // namespace stride
