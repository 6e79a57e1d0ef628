// The theorems of potential-based reward shaping, checked by brute force.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "shaping/potential.h"
#include "shaping/shaping_reward.h"

namespace stride {
namespace {

TEST(ShapingReward, OfAnEpisodeTelescopes) {
  const Potential potential = load_potential(STRIDE_TEST_DATA "/hamner.potential.json");
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> offset(-0.2, 0.2);
  const double gamma = 0.97, decision_s = 0.03;
  const int decisions = 60;
  std::vector<double> phi;
  for (int t = 0; t <= decisions; ++t) {
    const double phase = potential.phase_at(t * decision_s);
    Pose pose = potential.target(phase);
    pose[PosePart::foot_l] += Eigen::Vector2d(offset(random), offset(random));
    pose.pelvis_height_m() += offset(random);
    phi.push_back(potential(pose, phase));
  }
  for (const bool fell : {false, true}) {
    double sum = 0;
    for (int t = 0; t < decisions; ++t)
      sum += std::pow(gamma, t) *
             shaping_reward(phi[t], phi[t + 1], gamma, fell && t == decisions - 1);
    const double expected = fell ? -phi[0] : std::pow(gamma, decisions) * phi[decisions] - phi[0];
    EXPECT_NEAR(sum, expected, 1e-10 * phi[0]);
  }
}

/// A random MDP with `kStates` states, of which the last is terminal, and its greedy policy by
/// value iteration. Rewards are shaped by Φ; `phi_terminal` is used for Φ(terminal).
constexpr int kStates = 7, kActions = 3, kTerminal = kStates - 1;

struct Mdp {
  double transition[kStates][kActions][kStates] = {};
  double reward[kStates][kActions][kStates] = {};
};

Mdp random_mdp(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Mdp mdp;
  for (int s = 0; s < kTerminal; ++s)
    for (int a = 0; a < kActions; ++a) {
      double sum = 0;
      for (double& p : mdp.transition[s][a]) sum += p = std::pow(uniform(random), 3);
      for (double& p : mdp.transition[s][a]) p /= sum;
      for (double& r : mdp.reward[s][a]) r = uniform(random);
    }
  return mdp;
}

std::array<int, kTerminal> greedy_policy(const Mdp& mdp, const std::array<double, kStates>& phi,
                                         bool zero_at_the_end) {
  const double gamma = 0.9;
  std::array<double, kStates> value{};
  std::array<int, kTerminal> policy{};
  for (int sweep = 0; sweep < 600; ++sweep)
    for (int s = 0; s < kTerminal; ++s) {
      double best = -1e300;
      for (int a = 0; a < kActions; ++a) {
        double q = 0;
        for (int next = 0; next < kStates; ++next) {
          const bool ended = next == kTerminal;
          const double f = shaping_reward(phi[s], phi[next], gamma, ended && zero_at_the_end);
          q += mdp.transition[s][a][next] *
               (mdp.reward[s][a][next] + f + (ended ? 0 : gamma * value[next]));
        }
        if (q > best) best = q, policy[s] = a;
      }
      value[s] = best;
    }
  return policy;
}

TEST(ShapingReward, KeepsTheGreedyPolicyUnderAnyPotentialThatIsZeroAtTheEnd) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> potential(0, 50);
  int changed_by_a_terminal_potential = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const Mdp mdp = random_mdp(random);
    std::array<double, kStates> phi;
    for (double& each : phi) each = potential(random);
    const auto unshaped = greedy_policy(mdp, {}, true);
    EXPECT_EQ(greedy_policy(mdp, phi, true), unshaped) << "trial " << trial;
    changed_by_a_terminal_potential += greedy_policy(mdp, phi, false) != unshaped;
  }
  // Grześ 2017: Φ(terminal) ≠ 0 rewards ending there, and the optimal policy changes.
  EXPECT_GT(changed_by_a_terminal_potential, 15);
}

}  // namespace
}  // namespace stride
