#include "train/ppo/rollout_batch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "extract/io/random.h"

namespace stride::ppo {
namespace {

/// Two environments, thirty decisions, episodes that end in either way.
RolloutBatch some_batch() {
  RolloutBatch batch;
  batch.environments = 2;
  batch.steps = 30;
  Random random(5);
  const auto draw = [&](Eigen::Index n) {
    Vector v(n);
    for (float& x : v) x = static_cast<float>(normal(random));
    return v;
  };
  batch.rewards = draw(60);
  batch.values = draw(62);
  batch.ends.assign(60, EpisodeEnd::none);
  batch.ends[2 * 7] = batch.ends[2 * 20 + 1] = EpisodeEnd::terminated;
  batch.ends[2 * 12] = batch.ends[2 * 12 + 1] = batch.ends[2 * 25 + 1] = EpisodeEnd::truncated;
  batch.truncated_values = draw(3);
  return batch;
}

/// Σ (γλ)ᵏ δₖ from each decision to the end of its episode or of the batch, term by term.
TEST(Advantages, AreTheSumOfDiscountedTemporalDifferencesOfTheirEpisode) {
  const double gamma = 0.9, lambda = 0.8;
  RolloutBatch batch = some_batch();
  estimate_advantages(gamma, lambda, batch);
  const auto truncated = [&](int column) {
    int before = 0;
    for (int i = 0; i < column; ++i)
      before += batch.ends[static_cast<std::size_t>(i)] == EpisodeEnd::truncated;
    return batch.truncated_values[before];
  };
  for (int start = 0; start < 60; ++start) {
    double sum = 0, factor = 1;
    for (int i = start; i < 60; i += 2) {
      const EpisodeEnd end = batch.ends[static_cast<std::size_t>(i)];
      const double next = end == EpisodeEnd::terminated  ? 0
                          : end == EpisodeEnd::truncated ? truncated(i)
                                                         : batch.values[i + 2];
      sum += factor * (batch.rewards[i] + gamma * next - batch.values[i]);
      factor *= gamma * lambda;
      if (end != EpisodeEnd::none) break;
    }
    EXPECT_NEAR(batch.advantages[start], sum, 1e-5) << start;
    EXPECT_NEAR(batch.returns[start], sum + batch.values[start], 1e-5) << start;
  }
}

TEST(Advantages, WithLambdaOneAreReturnsLessValues) {
  RolloutBatch batch = some_batch();
  estimate_advantages(0.9, 1, batch);
  double expected = 0;  // of environment 0 from decision 0 to its fall at decision 7
  for (int t = 7; t >= 0; --t) expected = batch.rewards[2 * t] + 0.9 * expected;
  EXPECT_NEAR(batch.returns[0], expected, 1e-5);
}

/// Shaping (Ng et al. 1999): with F in the rewards and Φ taken off the values nothing is left of Φ.
TEST(Advantages, AreTheSameUnderAPotentialThatTheValuesKnow) {
  const double gamma = 0.9;
  RolloutBatch plain = some_batch(), shaped = some_batch();
  Random random(6);
  Vector phi(62), phi_truncated(3);
  for (float& x : phi) x = static_cast<float>(normal(random));
  for (float& x : phi_truncated) x = static_cast<float>(normal(random));
  for (int i = 0, k = 0; i < 60; ++i) {
    const EpisodeEnd end = shaped.ends[static_cast<std::size_t>(i)];
    const float next = end == EpisodeEnd::terminated  ? 0
                       : end == EpisodeEnd::truncated ? phi_truncated[k++]
                                                      : phi[i + 2];
    shaped.rewards[i] += static_cast<float>(gamma) * next - phi[i];
  }
  shaped.values -= phi;
  shaped.truncated_values -= phi_truncated;
  estimate_advantages(gamma, 0.8, plain);
  estimate_advantages(gamma, 0.8, shaped);
  EXPECT_LT((plain.advantages - shaped.advantages).cwiseAbs().maxCoeff(), 1e-5f);
}

}  // namespace
}  // namespace stride::ppo
