#include "extract/tracking/spline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stride {
namespace {

TEST(Spline, ReproducesACubic) {
  const auto cubic = [](double t) {
    return Eigen::Vector2d(t * t * t - 2 * t, 1 - t + 0.5 * t * t - 0.25 * t * t * t);
  };
  const std::vector<double> t{-1, -0.2, 0.5, 0.9, 2, 2.2};
  std::vector<Eigen::Vector2d> p;
  for (const double s : t) p.push_back(cubic(s));
  const tracking::Spline spline(t, p);
  for (double s = -1; s <= 2.2; s += 0.05) EXPECT_LT((spline(s) - cubic(s)).norm(), 1e-12) << s;
}

TEST(Spline, IsThePolynomialThroughFewPointsAndStraightOutside) {
  EXPECT_EQ(tracking::Spline({1}, {{3, 4}})(7), Eigen::Vector2d(3, 4));
  EXPECT_EQ(tracking::Spline({0, 2}, {{0, 0}, {2, 4}})(3), Eigen::Vector2d(3, 6));
  const tracking::Spline parabola({0, 1, 2}, {{0, 0}, {1, 1}, {2, 4}});
  EXPECT_LT((parabola(1.5) - Eigen::Vector2d(1.5, 2.25)).norm(), 1e-12);
  EXPECT_LT((parabola(3) - Eigen::Vector2d(3, 8)).norm(), 1e-12);
}

}  // namespace
}  // namespace stride
