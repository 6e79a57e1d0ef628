#pragma once

#include <Eigen/Core>

namespace stride {

/// Least squares of several signals over the same rows, reweighted by Cauchy's weights.
struct RobustFit {
  Eigen::MatrixXd coefficients;        // a column a signal
  double spread = 0;                   // median distance of a row from the fit
  double negative_log_likelihood = 0;  // −log likelihood without constants
};

/// `weights` of the rows, 0 … 1; `least_spread`: no row is believed to be better;
/// `first_two_alike`: weight of the squared difference of the first two coefficients.
RobustFit robust_fit(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& signals,
                     const Eigen::VectorXd& weights, double least_spread,
                     double first_two_alike = 0);

}  // namespace stride
