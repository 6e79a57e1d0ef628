#include "train/network/adam.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stride {
namespace {

TEST(Adam, FirstStepIsTheRateAgainstTheSignOfTheGradient) {
  network::Adam<double> adam;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(3), g = Eigen::Vector3d(1e-3, -50, 2);
  EXPECT_NEAR(adam.descend(x, g, 0.1), std::sqrt(1e-6 + 2500 + 4), 1e-12);
  EXPECT_NEAR(x[0], -0.1, 1e-5);
  EXPECT_NEAR(x[1], 0.1, 1e-9);
  EXPECT_NEAR(x[2], -0.1, 1e-9);
}

TEST(Adam, FollowsAlgorithm1OfThePaper) {
  network::Adam<double> adam{.options = {.beta1 = 0.8, .beta2 = 0.95, .epsilon = 1e-3}};
  Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 2);
  double theta = 2, m = 0, v = 0;
  for (int t = 1; t <= 50; ++t) {
    Eigen::VectorXd g = 3 * x.array().square() - 1;
    const double gradient = 3 * theta * theta - 1;
    m = 0.8 * m + 0.2 * gradient;
    v = 0.95 * v + 0.05 * gradient * gradient;
    const double m_hat = m / (1 - std::pow(0.8, t)), v_hat = v / (1 - std::pow(0.95, t));
    theta -= 0.05 * m_hat / (std::sqrt(v_hat) + 1e-3);
    adam.descend(x, g, 0.05);
    ASSERT_NEAR(x[0], theta, 1e-12) << "step " << t;
  }
}

TEST(Adam, LimitsTheNormOfTheGradient) {
  network::Adam<double> limited{.options = {.gradient_norm_limit = 1}}, plain;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2), y = x;
  Eigen::VectorXd g = Eigen::Vector2d(3, 4), unit = Eigen::Vector2d(0.6, 0.8);
  EXPECT_EQ(limited.descend(x, g, 0.1), 5);
  plain.descend(y, unit, 0.1);
  EXPECT_NEAR((x - y).norm(), 0, 1e-15);
  EXPECT_NEAR((limited.m - plain.m).norm(), 0, 1e-15);
}

TEST(Adam, FindsTheMinimumOfABowl) {
  network::Adam<float> adam;
  Eigen::VectorXf x = Eigen::Vector2f(5, -3);
  for (int i = 0; i < 3000; ++i) {
    Eigen::VectorXf g = Eigen::Vector2f(2 * (x[0] - 1), 200 * (x[1] - 2));
    adam.descend(x, g, 0.01);
  }
  EXPECT_NEAR(x[0], 1, 1e-3);
  EXPECT_NEAR(x[1], 2, 1e-3);
}

}  // namespace
}  // namespace stride
