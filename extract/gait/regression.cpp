#include "extract/gait/regression.h"

#include <algorithm>

namespace stride {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// Covariance of a place at a time with a sample.
double covariance_with(const Covariance& c, double time_s, int left, const Sample& s) {
  const double with_end = c(time_s, left, s.time_s, s.left);
  return s.is_way() ? with_end - c(time_s, left, s.since_s, s.left) : with_end;
}

MatrixXd covariance_matrix(const Covariance& covariance, const std::vector<Sample>& samples) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Sample& s = samples[i];
    for (Eigen::Index j = 0; j <= i; ++j) {
      double c = covariance_with(covariance, s.time_s, s.left, samples[j]);
      if (s.is_way()) c -= covariance_with(covariance, s.since_s, s.left, samples[j]);
      matrix(i, j) = matrix(j, i) = c;
    }
  }
  return matrix;
}

/// The covariance of each coordinate; the same for both unless the trunk drifts.
std::array<Covariance, 2> covariances(const GaitKernel& kernel, const GroupData& data) {
  const bool paired = data.group.paired();
  return {Covariance{kernel, paired, data.drift.x()}, Covariance{kernel, paired, data.drift.y()}};
}

}  // namespace

VectorXd coordinate(const GroupData& data, int axis) {
  VectorXd y(static_cast<Eigen::Index>(data.samples.size()));
  for (Eigen::Index i = 0; i < y.size(); ++i)
    y(i) = data.samples[i].p_px[axis] / data.scale_px[axis];
  return y;
}

std::array<MatrixXd, 2> covariance_matrices(const GaitKernel& kernel, const GroupData& data) {
  const auto [x, y] = covariances(kernel, data);
  const MatrixXd first = covariance_matrix(x, data.samples);
  return {first, data.group.paired() ? first : covariance_matrix(y, data.samples)};
}

Regression::Regression(const GaitKernel& kernel, GroupData group_data)
    : data_(std::move(group_data)), covariance_(covariances(kernel, data_)) {
  auto matrices = covariance_matrices(kernel, data_);
  for (int axis = 0; axis < 2; ++axis) {
    MatrixXd& noisy = matrices[axis];
    const double unit = data_.scale_px[axis] * data_.scale_px[axis];
    for (Eigen::Index i = 0; i < noisy.rows(); ++i)
      noisy(i, i) += data_.samples[i].variance_px2[axis] / unit + kJitter * noisy(i, i);
    factor_[axis].compute(noisy);
    weights_[axis] = factor_[axis].solve(coordinate(data_, axis));
  }
}

Vector2d Regression::place(double time_s, int left) const {
  Vector2d p_px;
  VectorXd c;
  for (int axis = 0; axis < 2; ++axis) {
    if (axis == 0 || !data_.group.paired()) c = with_samples(covariance_[axis], time_s, left);
    p_px[axis] = data_.mean_px[axis] + data_.scale_px[axis] * c.dot(weights_[axis]);
  }
  return p_px;
}

Estimate Regression::at(double time_s, int left) const {
  Estimate estimate;
  VectorXd c;
  for (int axis = 0; axis < 2; ++axis) {
    if (axis == 0 || !data_.group.paired()) c = with_samples(covariance_[axis], time_s, left);
    const double scale = data_.scale_px[axis];
    estimate.p_px[axis] = data_.mean_px[axis] + scale * c.dot(weights_[axis]);
    const double own = covariance_[axis](time_s, left, time_s, left);
    const VectorXd white = factor_[axis].matrixL().solve(c);
    estimate.variance_px2[axis] = std::max(0.0, scale * scale * (own - white.squaredNorm()));
  }
  return estimate;
}

Vector2d Regression::residual_px(std::size_t i) const {
  Vector2d residual;
  for (int axis = 0; axis < 2; ++axis)
    residual[axis] = data_.samples[i].variance_px2[axis] / data_.scale_px[axis] *
                     weights_[axis](static_cast<Eigen::Index>(i));
  return residual;
}

VectorXd Regression::with_samples(const Covariance& function, double time_s, int left) const {
  VectorXd c(static_cast<Eigen::Index>(data_.samples.size()));
  for (Eigen::Index i = 0; i < c.size(); ++i)
    c(i) = covariance_with(function, time_s, left, data_.samples[i]);
  return c;
}

}  // namespace stride
