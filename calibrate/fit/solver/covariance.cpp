#include <ceres/crs_matrix.h>

#include <Eigen/Dense>

#include "calibrate/fit/solver/solve.h"
#include "extract/skeleton/least_squares.h"

namespace stride::fit {

void estimate_covariance(const FitProblem& problem, StrideFit& fit) {
  double ground_m = first_ground_m(fit.runner);
  ceres::Problem ceres;
  build(problem, fit, Loss::tukey, &ground_m, ceres);
  ceres::Problem::EvaluateOptions options;
  std::vector<int> column;  // of `flattened` for every column of the Jacobian; −1: none
  int offset = 0;
  for_each_block(fit.runner, [&](auto& block) {
    if (!ceres.IsParameterBlockConstant(block.data())) {
      options.parameter_blocks.push_back(block.data());
      const int free = ceres.ParameterBlockTangentSize(block.data());
      for (int i = 0; i < free; ++i) column.push_back(offset + i);
    }
    offset += static_cast<int>(block.size());
  });
  if (!problem.stance.phases.empty()) {
    options.parameter_blocks.push_back(&ground_m);
    column.push_back(-1);
  }
  if (fit.heels_seen) {
    options.parameter_blocks.push_back(fit.heel.data());
    column.insert(column.end(), heel::size, -1);
  }
  for (Eigen::Vector2d& pelvis : fit.pelvis_px) options.parameter_blocks.push_back(pelvis.data());
  ceres::CRSMatrix jacobian;
  ceres.Evaluate(options, nullptr, nullptr, nullptr, &jacobian);

  // Normal equations of the shared parameters S, of every pelvis V, and of both W; then S − W V⁻¹
  // Wᵀ.
  const int shared = static_cast<int>(column.size()),
            frames = static_cast<int>(fit.pelvis_px.size());
  Eigen::MatrixXd s = Eigen::MatrixXd::Zero(shared, shared);
  std::vector<Eigen::Matrix2d> v(frames, Eigen::Matrix2d::Zero());
  std::vector<Eigen::MatrixXd> w(frames, Eigen::MatrixXd::Zero(shared, 2));
  for (int row = 0; row < jacobian.num_rows; ++row)
    for (int a = jacobian.rows[row]; a < jacobian.rows[row + 1]; ++a)
      for (int b = jacobian.rows[row]; b < jacobian.rows[row + 1]; ++b) {
        const int i = jacobian.cols[a], j = jacobian.cols[b];
        const double product = jacobian.values[a] * jacobian.values[b];
        if (i < shared && j < shared) s(i, j) += product;
        if (i < shared && j >= shared) w[(j - shared) / 2](i, (j - shared) % 2) += product;
        if (i >= shared && j >= shared)
          v[(i - shared) / 2]((i - shared) % 2, (j - shared) % 2) += product;
      }
  for (int frame = 0; frame < frames; ++frame)
    if (v[frame].determinant() > 0) s -= w[frame] * v[frame].inverse() * w[frame].transpose();
  const Eigen::MatrixXd inverse = pseudo_inverse(s);
  fit.covariance = Eigen::MatrixXd::Zero(offset, offset);
  for (int i = 0; i < shared; ++i)
    for (int j = 0; j < shared; ++j)
      if (column[i] >= 0 && column[j] >= 0) fit.covariance(column[i], column[j]) = inverse(i, j);
}

}  // namespace stride::fit
