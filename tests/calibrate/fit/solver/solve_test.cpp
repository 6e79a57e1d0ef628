#include "calibrate/fit/solver/solve.h"

#include <ceres/covariance.h>
#include <gtest/gtest.h>

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
  EXPECT_NEAR(truth.fit.rms_px, 2 * std::numbers::sqrt2, 0.3);  // of those that are believed
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
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  ceres::Covariance whole(options);
  const double* cadence = truth.fit.runner.cadence.data();
  const double* body = truth.fit.runner.body.data();
  ASSERT_TRUE(whole.Compute({{cadence, cadence}, {body, body}}, &ceres));
  std::array<double, cadence::size * cadence::size> of_cadence;
  std::array<double, body::size * body::size> of_body;
  ASSERT_TRUE(whole.GetCovarianceBlock(cadence, cadence, of_cadence.data()));
  ASSERT_TRUE(whole.GetCovarianceBlock(body, body, of_body.data()));
  EXPECT_NEAR(truth.fit.period_sd_s(), std::sqrt(of_cadence[0]), 1e-6 * truth.fit.period_sd_s());
  const int offset = fit::kSizeOf<&Runner::camera> + fit::kSizeOf<&Runner::cadence>;
  for (int i = 0; i < body::size; ++i) {
    const double variance = of_body[i * body::size + i];
    EXPECT_NEAR(truth.fit.covariance(offset + i, offset + i), variance, 1e-5 * variance) << i;
  }
}

}  // namespace
}  // namespace stride
