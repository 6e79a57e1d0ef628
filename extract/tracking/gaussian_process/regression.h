#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <vector>

#include "extract/tracking/gaussian_process/kernel.h"
#include "extract/tracking/gaussian_process/samples.h"

namespace stride::gaussian_process {

constexpr double kJitter = 1e-9;  // added to the diagonal, relative to the largest variance

/// Covariance matrix of the samples, one for each coordinate.
std::array<Eigen::MatrixXd, 2> covariance_matrices(const GaitKernel& kernel, const GroupData& data);

/// Samples of a coordinate in units of the scale.
Eigen::VectorXd coordinate(const GroupData& data, int axis);

/// Gaussian process regression of one group. Times are relative to the origin.
class Regression {
 public:
  Regression(const GaitKernel& kernel, GroupData group_data);

  const std::vector<Sample>& samples() const { return data_.samples; }

  /// Posterior mean of one leg's joint at each time; `left` 0 or 1.
  std::vector<Eigen::Vector2d> places(const std::vector<double>& times_s, int left) const;

  /// The same with variances.
  std::vector<Estimate> estimates(const std::vector<double>& times_s, int left) const;

  /// −log likelihood of the samples without constants.
  double negative_log_likelihood() const;

  /// Residual of sample i: the sample minus its posterior mean.
  Eigen::Vector2d residual_px(std::size_t i) const;

 private:
  /// Covariance of the samples (rows) with positions at times (columns).
  std::array<Eigen::MatrixXd, 2> with_samples(const std::vector<double>& times_s, int left) const;

  GroupData data_;
  std::array<Covariance, 2> covariance_;
  std::array<Eigen::LLT<Eigen::MatrixXd>, 2> factor_;
  std::array<Eigen::VectorXd, 2> weights_;
};

}  // namespace stride::gaussian_process
