#include "extract/skeleton/robust_linear_fit.h"

#include <Eigen/Dense>
#include <cmath>

#include "extract/skeleton/least_squares.h"
#include "extract/skeleton/robust_fit.h"

namespace stride {

RobustLinearFit robust_linear_fit(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& signals,
                                  const Eigen::VectorXd& weights, double least_spread,
                                  double alike) {
  constexpr double kRidge = 1e-3;
  RobustLinearFit fit;
  const auto weighted_fit = [&](const Eigen::VectorXd& robust) -> Eigen::VectorXd {
    Eigen::MatrixXd normal = rows.transpose() * robust.asDiagonal() * rows;
    normal.diagonal().array() += kRidge;
    if (alike > 0)
      normal.topLeftCorner<2, 2>() += alike * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
    fit.coefficients = solve_positive(normal, rows.transpose() * robust.asDiagonal() * signals);
    return (signals - rows * fit.coefficients).rowwise().norm();
  };
  const RobustFit robust =
      robust_fit(weights, {.rounds = 4, .least_spread = least_spread}, weighted_fit);
  fit.spread = robust.spread;
  const Eigen::ArrayXd in_spreads = robust.distances / (2 * robust.spread);
  fit.negative_log_likelihood =
      (weights.array() * (std::log(robust.spread) + in_spreads.square().log1p())).sum();
  return fit;
}

}  // namespace stride
