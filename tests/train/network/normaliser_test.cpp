#include "train/network/normaliser.h"

#include <gtest/gtest.h>

#include "extract/io/random.h"

namespace stride {
namespace {

TEST(Normaliser, IsMeanAndDeviationOfSamplesAndTheirMirrorImages) {
  const environment::Mirror mirror = environment::mirror_by_name({"a_r", "a_l", "b", "phase_sin"});
  network::Normaliser normaliser(mirror);
  Random random(2);
  constexpr int kSamples = 500;
  Eigen::MatrixXd all(4, 2 * kSamples);
  for (int i = 0; i < kSamples; ++i) {
    Eigen::VectorXd x(4);
    x << 3 + normal(random), -1 + 2 * normal(random), 1000 + 0.1 * normal(random), uniform(random);
    normaliser.add(x);
    all.col(2 * i) = x;
    mirror.apply(x, all.col(2 * i + 1));
  }
  normaliser.publish();
  const Eigen::VectorXd mean = all.rowwise().mean();
  const Eigen::VectorXd sd =
      (all.colwise() - mean).array().square().rowwise().mean().sqrt().matrix();
  EXPECT_LT((normaliser.mean() - mean).norm(), 1e-9);
  EXPECT_LT((normaliser.inverse_sd().cwiseProduct(sd) - Eigen::VectorXd::Ones(4)).norm(), 1e-6);
  EXPECT_NEAR(normaliser.mean()[3], 0, 1e-15);
}

TEST(Normaliser, AFeatureThatNeverMovesCountsAsNothing) {
  network::Normaliser normaliser(environment::mirror_by_name({"x", "y"}));
  for (int i = 0; i < 10; ++i) normaliser.add(Eigen::VectorXd{{100, double(i)}});
  normaliser.publish();
  Eigen::MatrixXf x(2, 1);
  x << 105, 1e9f;
  normaliser.apply(x);
  EXPECT_EQ(x(0, 0), 0);
  EXPECT_EQ(x(1, 0), static_cast<float>(network::Normaliser::kLimit));
}

}  // namespace
}  // namespace stride
