#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <vector>

#include "extract/tracking/gaussian_process/kernel.h"
#include "extract/tracking/gaussian_process/samples.h"

namespace stride::gaussian_process {

constexpr double kJitter = 1e-9;  // of the largest variance, against rounding

/// Covariance of the samples, for each coordinate.
std::array<Eigen::MatrixXd, 2> covariance_matrices(const GaitKernel& kernel, const GroupData& data);

/// The samples of a coordinate in units of the scale.
Eigen::VectorXd coordinate(const GroupData& data, int axis);

/// Gaussian process regression of one group; times from the origin.
class Regression {
 public:
  Regression(const GaitKernel& kernel, GroupData group_data);

  const std::vector<Sample>& samples() const { return data_.samples; }

  /// Where the joint of one leg is at each time; `left` 0 or 1.
  std::vector<Eigen::Vector2d> places(const std::vector<double>& times_s, int left) const;

  /// The same with variances.
  std::vector<Estimate> estimates(const std::vector<double>& times_s, int left) const;

  /// −log of the probability of the samples, without constants.
  double negative_log_likelihood() const;

  /// Sample i minus what the regression makes of it.
  Eigen::Vector2d residual_px(std::size_t i) const;

 private:
  /// Covariance of the samples (rows) with places at times.
  std::array<Eigen::MatrixXd, 2> with_samples(const std::vector<double>& times_s, int left) const;

  GroupData data_;
  std::array<Covariance, 2> covariance_;
  std::array<Eigen::LLT<Eigen::MatrixXd>, 2> factor_;
  std::array<Eigen::VectorXd, 2> weights_;
};

}  // namespace stride::gaussian_process
