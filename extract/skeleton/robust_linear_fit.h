#pragma once

#include <Eigen/Core>

namespace stride {

/// Least squares of several signals over the same rows, reweighted by Cauchy's weights.
struct RobustLinearFit {
  Eigen::MatrixXd coefficients;        // a column a signal
  double spread = 0;                   // median distance of a row from the fit
  double negative_log_likelihood = 0;  // without constants
};

/// `weights` of the rows, 0 … 1; the spread is at least `least_spread`. `alike` weighs the squared
/// difference of the first two coefficients.
RobustLinearFit robust_linear_fit(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& signals,
                                  const Eigen::VectorXd& weights, double least_spread,
                                  double alike = 0);

}  // namespace stride
