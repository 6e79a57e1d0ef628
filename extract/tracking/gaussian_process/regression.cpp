#include "extract/tracking/gaussian_process/regression.h"

#include <algorithm>
#include <map>

namespace stride::gaussian_process {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// The distinct times at which samples begin and end; consecutive frames share them.
struct Ends {
  Instants instants;
  std::vector<Eigen::Index> end, begin;  // of each sample; begin −1: a position
};
Ends ends_of(const std::vector<Sample>& samples) {
  Ends ends;
  std::map<std::pair<int, double>, Eigen::Index> known;
  const auto at = [&](const Sample& s, double time_s) {
    return known.try_emplace({s.left, time_s}, static_cast<Eigen::Index>(known.size()))
        .first->second;
  };
  for (const Sample& s : samples) {
    ends.end.push_back(at(s, s.time_s));
    ends.begin.push_back(s.is_displacement() ? at(s, s.since_s) : -1);
  }
  ends.instants.time_s.resize(static_cast<Eigen::Index>(known.size()));
  ends.instants.left.resize(static_cast<Eigen::Index>(known.size()));
  for (const auto& [instant, i] : known) {
    ends.instants.left[i] = instant.first;
    ends.instants.time_s[i] = instant.second;
  }
  return ends;
}

/// Covariances with samples from covariances with times (rows): a displacement is the difference of
/// its ends.
MatrixXd rows_of_samples(const MatrixXd& of_instants, const Ends& ends) {
  MatrixXd result(static_cast<Eigen::Index>(ends.end.size()), of_instants.cols());
  for (Eigen::Index j = 0; j < result.cols(); ++j)
    for (Eigen::Index i = 0; i < result.rows(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      result(i, j) =
          of_instants(ends.end[k], j) - (ends.begin[k] < 0 ? 0.0 : of_instants(ends.begin[k], j));
    }
  return result;
}

MatrixXd covariance_matrix(const Covariance& covariance, const Ends& ends) {
  const MatrixXd rows = rows_of_samples(covariance(ends.instants, ends.instants), ends);
  return rows_of_samples(rows.transpose(), ends);
}

/// The covariance matrix of each coordinate; equal for both unless the trunk drifts.
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
  const Ends ends = ends_of(data.samples);
  const MatrixXd first = covariance_matrix(x, ends);
  return {first, data.group.paired() ? first : covariance_matrix(y, ends)};
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

std::vector<Vector2d> Regression::places(const std::vector<double>& times_s, int left) const {
  const auto with = with_samples(times_s, left);
  std::vector<Vector2d> places(times_s.size());
  for (int axis = 0; axis < 2; ++axis) {
    const VectorXd y = with[axis].transpose() * weights_[axis];
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i][axis] =
          data_.mean_px[axis] + data_.scale_px[axis] * y(static_cast<Eigen::Index>(i));
  }
  return places;
}

std::vector<Estimate> Regression::estimates(const std::vector<double>& times_s, int left) const {
  const auto with = with_samples(times_s, left);
  std::vector<Estimate> estimates(times_s.size());
  for (int axis = 0; axis < 2; ++axis) {
    const VectorXd y = with[axis].transpose() * weights_[axis];
    const MatrixXd white = factor_[axis].matrixL().solve(with[axis]);
    const double scale = data_.scale_px[axis];
    for (std::size_t i = 0; i < estimates.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const double known = white.col(column).squaredNorm();
      estimates[i].p_px[axis] = data_.mean_px[axis] + scale * y(column);
      estimates[i].variance_px2[axis] =
          std::max(0.0, scale * scale * (covariance_[axis].at(times_s[i]) - known));
    }
  }
  return estimates;
}

double Regression::negative_log_likelihood() const {
  double sum = 0;
  for (int axis = 0; axis < 2; ++axis)
    sum += 0.5 * coordinate(data_, axis).dot(weights_[axis]) +
           factor_[axis].matrixLLT().diagonal().array().log().sum();
  return sum;
}

Vector2d Regression::residual_px(std::size_t i) const {
  Vector2d residual;
  for (int axis = 0; axis < 2; ++axis)
    residual[axis] = data_.samples[i].variance_px2[axis] / data_.scale_px[axis] *
                     weights_[axis](static_cast<Eigen::Index>(i));
  return residual;
}

std::array<MatrixXd, 2> Regression::with_samples(const std::vector<double>& times_s,
                                                 int left) const {
  const auto n = static_cast<Eigen::Index>(times_s.size());
  const Instants at{Eigen::Map<const Eigen::ArrayXd>(times_s.data(), n),
                    Eigen::ArrayXd::Constant(n, left)};
  const Ends ends = ends_of(data_.samples);
  const MatrixXd first = rows_of_samples(covariance_[0](ends.instants, at), ends);
  return {first,
          data_.group.paired() ? first : rows_of_samples(covariance_[1](ends.instants, at), ends)};
}

}  // namespace stride::gaussian_process
