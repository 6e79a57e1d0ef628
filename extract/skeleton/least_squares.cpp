#include "extract/skeleton/least_squares.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

namespace stride {

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a) {
  return least_squares(a, Eigen::MatrixXd::Identity(a.rows(), a.rows()));
}

Eigen::MatrixXd solve_positive(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.llt().solve(b);
}

}  // namespace stride
