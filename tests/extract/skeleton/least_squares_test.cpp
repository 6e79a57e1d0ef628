#include "extract/skeleton/least_squares.h"

#include <gtest/gtest.h>

namespace stride {
namespace {

TEST(LeastSquares, OfALineAreItsCoefficients) {
  Eigen::MatrixXd a(4, 2), b(4, 2);
  a << 1, 0, 1, 1, 1, 2, 1, 3;
  b << 2, 1, 5, 0, 8, 0, 11, -1;  // 2 + 3 t; and 0.9 − 0.6 t with residuals
  const Eigen::MatrixXd x = least_squares(a, b);
  EXPECT_TRUE(x.isApprox((Eigen::Matrix2d() << 2, 0.9, 3, -0.6).finished(), 1e-12)) << x;
}

TEST(LeastSquares, WithoutFullRankIsTheSolutionOfLeastNorm) {
  Eigen::MatrixXd a(3, 2), b(3, 1);
  a << 1, 1, 2, 2, 3, 3;
  b << 4, 8, 12;
  EXPECT_TRUE(least_squares(a, b).isApprox(Eigen::Vector2d(2, 2), 1e-12));
}

TEST(PseudoInverse, FulfilsTheConditionsOfMooreAndPenrose) {
  Eigen::MatrixXd a(4, 3);
  a << 2, 0, 0, -1, 3, 0, 1, 3, 0, 0, 6, 0;
  a.col(2) = a.col(0) - 2 * a.col(1);  // of rank 2
  const Eigen::MatrixXd inverse = pseudo_inverse(a);
  EXPECT_TRUE((a * inverse * a).isApprox(a, 1e-12));
  EXPECT_TRUE((inverse * a * inverse).isApprox(inverse, 1e-12));
  EXPECT_TRUE((a * inverse).isApprox((a * inverse).transpose(), 1e-12));
  EXPECT_TRUE((inverse * a).isApprox((inverse * a).transpose(), 1e-12));
}

TEST(SolvePositive, FulfilsItsEquation) {
  const Eigen::Matrix3d a = (Eigen::Matrix3d() << 4, 1, 0, 1, 3, -1, 0, -1, 2).finished();
  const Eigen::MatrixXd b = (Eigen::MatrixXd(3, 2) << 1, 0, 2, -1, 3, 5).finished();
  EXPECT_TRUE((a * solve_positive(a, b)).isApprox(b, 1e-12));
}

}  // namespace
}  // namespace stride
