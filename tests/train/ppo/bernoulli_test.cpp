#include "train/ppo/bernoulli.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stride::ppo {
namespace {

const Matrix kLogits{{-3.0f, 0.0f, 0.4f}, {1.7f, -0.2f, 30.0f}};
const Matrix kTaken{{0.0f, 1.0f, 1.0f}, {1.0f, 0.0f, 1.0f}};

double p(double z) { return 1 / (1 + std::exp(-z)); }

TEST(Bernoulli, LogProbabilityIsTheSumOfLogsOfEachActionsProbability) {
  const Vector found = log_probability(kLogits, kTaken);
  for (int i = 0; i < 3; ++i) {
    double expected = 0;
    for (int k = 0; k < 2; ++k) {
      const double q = p(kLogits(k, i));
      expected += std::log(kTaken(k, i) > 0 ? q : 1 - q);
    }
    EXPECT_NEAR(found[i], expected, 1e-6);
  }
  EXPECT_NEAR(log_probability(Matrix{{-200.0f}}, Matrix{{1.0f}})[0], -200, 1e-4) << "overflow";
}

TEST(Bernoulli, DivergenceIsTheMeanDifferenceOfLogProbabilitiesAndZeroToItself) {
  const Matrix now{{-1.0f, 0.3f, 0.4f}, {1.0f, -0.6f, 2.0f}};
  const Vector found = divergence(kLogits, now);
  for (int i = 0; i < 3; ++i) {
    double expected = 0;
    for (int k = 0; k < 2; ++k) {
      const double before = p(kLogits(k, i)), after = p(now(k, i));
      expected += before * std::log(before / after);
      if (before < 1) expected += (1 - before) * std::log((1 - before) / (1 - after));
    }
    EXPECT_NEAR(found[i], expected, 1e-5);
  }
  EXPECT_LT(divergence(kLogits, kLogits).cwiseAbs().maxCoeff(), 1e-6f);
}

TEST(Bernoulli, EntropyIsLargestWhereBothAreAsLikely) {
  EXPECT_NEAR(entropy(Matrix{{0.0f}, {0.0f}})[0], 2 * std::log(2.0), 1e-6);
  EXPECT_NEAR(entropy(Matrix{{40.0f}})[0], 0, 1e-6);
  const double q = p(0.4);
  EXPECT_NEAR(entropy(Matrix{{0.4f}})[0], -q * std::log(q) - (1 - q) * std::log(1 - q), 1e-6);
}

TEST(Bernoulli, GradientsAreThoseOfFiniteDifferences) {
  const float h = 1e-2f;
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) {
      Matrix up = kLogits, down = kLogits;
      up(k, i) += h, down(k, i) -= h;
      const float by_log =
          (log_probability(up, kTaken)[i] - log_probability(down, kTaken)[i]) / (2 * h);
      const float by_entropy = (entropy(up)[i] - entropy(down)[i]) / (2 * h);
      EXPECT_NEAR(log_probability_gradient(kLogits, kTaken)(k, i), by_log, 1e-3);
      EXPECT_NEAR(entropy_gradient(kLogits)(k, i), by_entropy, 1e-3);
    }
}

}  // namespace
}  // namespace stride::ppo
