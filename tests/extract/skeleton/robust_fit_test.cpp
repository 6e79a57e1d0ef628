#include "extract/skeleton/robust_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stride {
namespace {

/// The weighted mean of values, and how far they are from it.
struct Mean {
  Eigen::VectorXd values;
  double mean = 0;

  Eigen::VectorXd operator()(const Eigen::VectorXd& weights) {
    mean = weights.dot(values) / weights.sum();
    return (values.array() - mean).abs();
  }
};

RobustFit robust_mean(Mean& mean, const RobustOptions& options, const Eigen::VectorXd& prior) {
  return robust_fit(prior, options, [&](const Eigen::VectorXd& w) { return mean(w); });
}

TEST(RobustFit, GivesGrossOutliersLittleSay) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(5, 0.1);
  Mean mean{Eigen::VectorXd(200)};
  for (Eigen::Index i = 0; i < 200; ++i) mean.values[i] = i % 4 == 0 ? 300 : normal(random);
  ASSERT_GT(mean.values.mean(), 70);
  robust_mean(mean, {.rounds = 50, .least_spread = 1e-9, .width = 2.5}, Eigen::VectorXd::Ones(200));
  EXPECT_NEAR(mean.mean, 5, 0.03);
}

TEST(RobustFit, EndsWhereCauchysWeightedMeanIsTheMean) {
  Mean mean{Eigen::VectorXd{{1, 2, 2.5, 4, 9}}};
  const Eigen::VectorXd prior{{1, 0.5, 1, 1, 0.25}};
  const RobustFit fit = robust_mean(mean, {.rounds = 500, .least_spread = 1e-9, .width = 3}, prior);
  double sum = 0, weights = 0, width = 3 * fit.spread;
  for (Eigen::Index i = 0; i < 5; ++i) {
    const double distance = std::abs(mean.values[i] - mean.mean);
    EXPECT_NEAR(fit.distances[i], distance, 1e-12);
    const double weight = prior[i] / (1 + std::pow(distance / width, 2));
    sum += weight * mean.values[i];
    weights += weight;
  }
  EXPECT_NEAR(sum / weights, mean.mean, 1e-12);
}

TEST(RobustFit, HasAsSpreadTheStandardDeviationOfNormalResiduals) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal(0, 0.7);
  Mean mean{Eigen::VectorXd(20000)};
  for (double& value : mean.values) value = normal(random);
  const RobustOptions options{.spread_per_median = kSigmaPerMedian, .least_spread = 1e-9};
  EXPECT_NEAR(robust_mean(mean, options, Eigen::VectorXd::Ones(20000)).spread, 0.7, 0.02);
}

TEST(RobustFit, OfExactValuesHasTheLeastSpread) {
  Mean mean{Eigen::VectorXd::Constant(9, 3.0)};
  EXPECT_EQ(robust_mean(mean, {.least_spread = 0.02}, Eigen::VectorXd::Ones(9)).spread, 0.02);
  EXPECT_EQ(mean.mean, 3);
}

}  // namespace
}  // namespace stride
