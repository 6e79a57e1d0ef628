#include "extract/skeleton/robust_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "extract/io/statistics.h"

namespace stride {

RobustFit robust_fit(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& signals,
                     const Eigen::VectorXd& weights, double least_spread, double first_two_alike) {
  constexpr int kReweightings = 4;
  RobustFit fit;
  Eigen::VectorXd robust = weights, distance;
  for (int round = 0; round < kReweightings; ++round) {
    Eigen::MatrixXd normal = rows.transpose() * robust.asDiagonal() * rows;
    normal.diagonal().array() += 1e-3;
    if (first_two_alike > 0)
      normal.topLeftCorner<2, 2>() +=
          first_two_alike * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
    fit.coefficients = normal.llt().solve(rows.transpose() * robust.asDiagonal() * signals);
    distance = (signals - rows * fit.coefficients).rowwise().norm();
    fit.spread = std::max(least_spread, median({distance.begin(), distance.end()}));
    robust = weights.array() / (1 + (distance / (2 * fit.spread)).array().square());
  }
  fit.negative_log_likelihood =
      (weights.array() *
       (std::log(fit.spread) + (distance / (2 * fit.spread)).array().square().log1p()))
          .sum();
  return fit;
}

}  // namespace stride
