#pragma once

#include <Eigen/Core>

namespace stride {

/// The x of least norm that makes |a x - b| least, a column for each of `b`; `a` may have any shape
/// and rank (Golub and Van Loan, Matrix Computations, 5.5: complete orthogonal decomposition).
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Of Moore and Penrose.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

/// The x of a x = b; `a` is symmetric and positive definite (LLᵀ).
Eigen::MatrixXd solve_positive(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace stride
