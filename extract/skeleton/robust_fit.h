#pragma once

#include <Eigen/Core>

namespace stride {

/// Least squares of several signals over the same rows, reweighted by Cauchy's weights.
struct RobustFit {
  Eigen::MatrixXd coefficients;  // a column a signal
  double spread = 0;             // median distance of a row from the fit
  double negative_log_likelihood = 0;           // −log likelihood without constants
};

/// `weights` of the rows, 0 … 1; `least_spread`: no row is believed to be better.
RobustFit robust_fit(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& signals,
                     const Eigen::VectorXd& weights, double least_spread);

}  // namespace stride
