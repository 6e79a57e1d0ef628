#include "calibrate/fit/solver/solve.h"

#include <ceres/crs_matrix.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>
#include <vector>

#include "calibrate/fit/solver/blocks.h"
#include "calibrate/fit/solver/noise.h"
#include "tests/calibrate/synthetic.h"

namespace stride {
namespace {

/// A clip and the fit that is its truth.
struct Truth {
  SagittalModel model = sagittal_model(osim::load_osim(osim::default_model_file()));
  fit::Marks marks;
  fit::FitOptions options;
  fit::StrideFit fit;

  explicit Truth(const SyntheticClip& clip) {
    marks = fit::observe(synthetic_trajectory(synthetic_runner(), model, clip), false);
    SyntheticClip clean = clip;
    clean.noise_px = clean.outliers = 0;
    const fit::Marks exact =
        fit::observe(synthetic_trajectory(synthetic_runner(), model, clean), false);
    options.mark_sd = 0;
    options.metres_per_pixel = 1 / 130.0;
    fit.runner = synthetic_runner();
    fit.harmonics = 3;
    fit.toes_seen = true;
    for (const fit::Mark& mark : exact.points)
      if (mark.part == BodyPart::pelvis) fit.pelvis_px.push_back(mark.z_px);
  }
  fit::FitProblem problem() const { return {marks, model, Directions(model), options, {}}; }
};

TEST(Noise, IsThatOfTheMarksAndSparesNoOutlier) {
  Truth truth({.duration_s = 6, .noise_px = 2, .outliers = 0.1});
  fit::estimate_noise(truth.problem(), truth.fit);
  // The truth was not fitted: the estimate makes good for parameters that took no part of it.
  const double marks = 2.0 * static_cast<double>(truth.marks.points.size());
  const double parameters = 2.0 * static_cast<double>(truth.fit.pelvis_px.size()) + 48;
  const double taken = std::sqrt(1 - parameters / marks);
  EXPECT_NEAR(truth.fit.sigma_px * taken, 2.2, 0.25);  // a tenth of outliers moves the median
  EXPECT_NEAR(truth.fit.outlier_fraction, 0.1, 0.03);
  EXPECT_NEAR(truth.fit.rms_px, 2 * std::numbers::sqrt2, 0.3);  // of the inliers
  EXPECT_LT(truth.fit.correlation, 1.5);                        // each mark has its own
  for (const fit::MarkResidual& mark : truth.fit.marks)
    EXPECT_EQ(mark.outlier, mark.r_px.norm() > 4.685 * std::numbers::sqrt2 * truth.fit.sigma_px);
}

TEST(Solve, StaysAtTheTruthOfMarksWithoutNoise) {
  Truth truth({.duration_s = 2});
  truth.fit.sigma_px = 0.01;
  const Eigen::VectorXd before = fit::flattened(truth.fit.runner);
  const fit::Solution solution = fit::solve(truth.problem(), truth.fit, fit::Loss::tukey, 1e-12);
  ASSERT_TRUE(truth.fit.ok) << truth.fit.failure;
  EXPECT_LT(solution.cost, 30);  // of the priors; a pixel at one mark would cost 5000
  const Eigen::VectorXd after = fit::flattened(truth.fit.runner);
  EXPECT_LT((after - before).cwiseAbs().maxCoeff(), 0.01);
}

TEST(Solve, ComesBackToTheTruthFromNearby) {
  Truth truth({.duration_s = 2});
  truth.fit.sigma_px = 0.5;
  truth.fit.runner.body[body::thigh] *= 1.05;
  truth.fit.runner.knee[0] += 0.1;
  truth.fit.runner.cadence[cadence::period_s] *= 1.01;
  fit::solve(truth.problem(), truth.fit, fit::Loss::cauchy, 1e-10);
  EXPECT_NEAR(truth.fit.runner.body[body::thigh], 0.43, 0.005);
  EXPECT_NEAR(truth.fit.runner.cadence[cadence::period_s], 0.69, 1e-3);
}

TEST(Covariance, WithThePelvisesEliminatedIsThatOfTheWholeProblem) {
  Truth truth({.duration_s = 1.2, .noise_px = 1});
  truth.fit.sigma_px = 1;
  fit::estimate_covariance(truth.problem(), truth.fit);

  double ground_m = fit::first_ground_m(truth.fit.runner);
  ceres::Problem ceres;
  fit::build(truth.problem(), truth.fit, fit::Loss::tukey, &ground_m, ceres);
  // Its Jacobian whole, parameters that are held left out.
  ceres::Problem::EvaluateOptions options;
  std::vector<double*> blocks;
  ceres.GetParameterBlocks(&blocks);
  std::map<const double*, int> first_column;
  int columns = 0;
  for (double* block : blocks) {
    if (ceres.IsParameterBlockConstant(block)) continue;
    options.parameter_blocks.push_back(block);
    first_column[block] = columns;
    columns += ceres.ParameterBlockTangentSize(block);
  }
  ceres::CRSMatrix sparse;
  ceres.Evaluate(options, nullptr, nullptr, nullptr, &sparse);
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(sparse.num_rows, columns);
  for (int row = 0; row < sparse.num_rows; ++row)
    for (int k = sparse.rows[row]; k < sparse.rows[row + 1]; ++k)
      jacobian(row, sparse.cols[k]) = sparse.values[k];
  const Eigen::MatrixXd whole =
      (jacobian.transpose() * jacobian).completeOrthogonalDecomposition().pseudoInverse();
  const int cadence = first_column.at(truth.fit.runner.cadence.data());
  const int body = first_column.at(truth.fit.runner.body.data());
  EXPECT_NEAR(truth.fit.period_sd_s(), std::sqrt(whole(cadence, cadence)),
              1e-5 * truth.fit.period_sd_s());
  const int offset = fit::kSizeOf<&Runner::camera> + fit::kSizeOf<&Runner::cadence>;
  for (int i = 0; i < body::size; ++i) {
    const double variance = whole(body + i, body + i);
    EXPECT_NEAR(truth.fit.covariance(offset + i, offset + i), variance, 1e-4 * variance) << i;
  }
}

}  // namespace
}  // namespace stride
