#include "calibrate/fit/fit.h"

#include <gtest/gtest.h>

#include "calibrate/gait/gait.h"
#include "tests/calibrate/synthetic.h"

namespace stride {
namespace {

/// Scale and roll are given, because the points do not determine them. The points are as good as
/// their residuals say.
fit::FitOptions known_scale_and_roll() {
  fit::FitOptions options;
  options.mark_sd = 0;
  options.metres_per_pixel = 1 / 130.0;
  options.roll_rad = {0, 1e-6};
  return options;
}

fit::StrideFit fit_clip(const SyntheticClip& clip, const SagittalModel& model,
                        const fit::FitOptions& options = known_scale_and_roll()) {
  return fit::fit_stride(
      fit::observe(synthetic_trajectory(synthetic_runner(), model, clip), clip.to_left), model,
      options);
}

/// Largest distance between knees and ankles of two fits on the model, m.
double largest_difference(const fit::StrideFit& a, const fit::StrideFit& b,
                          const SagittalModel& model) {
  double largest = 0;
  for (int i = 0; i < 50; ++i) {
    const CalibratedSample x = gait::pose_at(a, model, i / 50.0),
                           y = gait::pose_at(b, model, i / 50.0);
    for (const BodyPart part :
         {BodyPart::knee_r, BodyPart::ankle_r, BodyPart::knee_l, BodyPart::ankle_l})
      largest = std::max(largest, (x[part] - y[part]).norm());
  }
  return largest;
}

fit::StrideFit truth() {
  fit::StrideFit truth;
  truth.runner = synthetic_runner();
  truth.harmonics = kMaxHarmonics;
  return truth;
}

TEST(Fit, RecoversEverythingFromMarksWithoutNoise) {
  const SagittalModel model = default_sagittal_model();
  const fit::StrideFit fit = fit_clip({}, model);
  const Runner runner = synthetic_runner();
  ASSERT_TRUE(fit.ok) << fit.failure;
  EXPECT_EQ(fit.harmonics, 3);
  EXPECT_NEAR(fit.runner.cadence[cadence::period_s], 0.69, 1e-6);
  EXPECT_NEAR(fit.runner.cadence[cadence::drift_hz_s], 0.005, 1e-6);
  EXPECT_NEAR(fit.runner.camera[camera::drift_per_s], 0.004, 1e-6);
  for (std::size_t i = 0; i < runner.body.size(); ++i)
    EXPECT_NEAR(fit.runner.body[i], runner.body[i], i == body::trunk ? 1 : 1e-6) << i;  // no head
  for (std::size_t i = 0; i < runner.sides.size(); ++i)
    EXPECT_NEAR(fit.runner.sides[i], runner.sides[i], 1e-6) << i;
  // Angles of segments, because the points do not separate the pelvis' tilt from the thigh's angle.
  for (const int side : {1, -1})
    for (int i = 0; i < 20; ++i) {
      const double phase = i / 20.0;
      const auto angles = [&](const Runner& r) {
        const auto leg = leg_angles(r.hip.data(), r.knee.data(), r.ankle.data(), r.asymmetry.data(),
                                    3, side, phase);
        return Eigen::Vector3d(evaluate_series(r.tilt.data(), 2, phase) + leg.hip, leg.knee,
                               leg.ankle);
      };
      EXPECT_LT((angles(fit.runner) - angles(runner)).norm(), 1e-6) << side << " " << phase;
    }
  EXPECT_LT(fit.rms_px, 1e-4);
}

TEST(Fit, FindsWhereTheHeelsAreOnTheFeet) {
  const SagittalModel model = default_sagittal_model();
  SyntheticClip clip;
  clip.heels = true;
  const fit::StrideFit fit = fit_clip(clip, model);
  ASSERT_TRUE(fit.ok) << fit.failure;
  EXPECT_TRUE(fit.heels_seen);
  EXPECT_NEAR(fit.heel[heel::forward], -0.07, 1e-4);
  EXPECT_NEAR(fit.heel[heel::up], -0.06, 1e-4);
  EXPECT_LT(largest_difference(fit, fit_clip({}, model), model), 1e-4);
  EXPECT_TRUE(gait::pose_at(fit, model, 0.3)[BodyPart::heel_l].allFinite());
}

TEST(Fit, IsTheSameWithoutHeels) {
  const SagittalModel model = default_sagittal_model();
  SyntheticClip clip;
  clip.heels = true;
  clip.toes = false;
  const fit::StrideFit fit = fit_clip(clip, model);
  ASSERT_TRUE(fit.ok) << fit.failure;
  EXPECT_FALSE(fit.heels_seen);  // nor used: without toes they do not tell the foot's angle
  clip.heels = false;
  EXPECT_EQ(largest_difference(fit, fit_clip(clip, model), model), 0);
  EXPECT_FALSE(gait::pose_at(fit, model, 0.3)[BodyPart::heel_l].allFinite());
}

TEST(Fit, TenPercentGrossOutliersMoveNothingByAMillimetre) {
  const SagittalModel model = default_sagittal_model();
  const fit::StrideFit clean = fit_clip({}, model);
  for (const unsigned seed : {1u, 2u, 3u}) {
    const fit::StrideFit spoilt = fit_clip({.outliers = 0.1, .seed = seed}, model);
    EXPECT_LT(largest_difference(clean, spoilt, model), 1e-3) << "seed " << seed;
    EXPECT_NEAR(spoilt.outlier_fraction, 0.1, 0.035);
  }
}

TEST(Fit, DoesNotDependOnTheWayRateOrResolutionOfTheClip) {
  const SagittalModel model = default_sagittal_model();
  const fit::StrideFit right = fit_clip({.noise_px = 0.5}, model);
  const fit::StrideFit left = fit_clip({.to_left = true, .noise_px = 0.5}, model);
  EXPECT_LT(largest_difference(right, left, model), 1e-4);
  const fit::StrideFit fast = fit_clip({.rate_hz = 60, .noise_px = 0.5, .seed = 2}, model);
  EXPECT_LT(largest_difference(right, fast, model), 0.01);
  EXPECT_NEAR(fast.runner.cadence[cadence::period_s], 0.69, 1e-3);
}

TEST(Fit, PlacesLegsWithoutToes) {
  const SagittalModel model = default_sagittal_model();
  const fit::StrideFit fit = fit_clip({.toes = false, .noise_px = 1}, model);
  ASSERT_TRUE(fit.ok) << fit.failure;
  EXPECT_FALSE(fit.toes_seen);
  EXPECT_LT(largest_difference(fit, truth(), model), 0.02);
}

TEST(Fit, WithNumericDerivativesIsTheSame) {
  const SagittalModel model = default_sagittal_model();
  fit::FitOptions numeric = known_scale_and_roll();
  numeric.numeric_derivatives = true;
  numeric.harmonics = 3;
  fit::FitOptions automatic = numeric;
  automatic.numeric_derivatives = false;
  const SyntheticClip clip{.duration_s = 1.6, .noise_px = 0.5};
  EXPECT_LT(
      largest_difference(fit_clip(clip, model, numeric), fit_clip(clip, model, automatic), model),
      1e-4);
}

/// A random runner from the priors of the fit.
Runner random_runner(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Runner r = synthetic_runner();
  r.body[body::hip_x] = 0.01 * normal(random);
  r.body[body::hip_y] = 0.01 * normal(random);
  r.sides = {0.025 * normal(random), 0.01 * normal(random), 0.01 * normal(random),
             0.01 * normal(random),  0.01 * normal(random), 0.007 * normal(random),
             0.007 * normal(random)};
  r.tilt[0] = (-4 + 4 * normal(random)) * kDegree;
  for (double& each : r.asymmetry) each = 3 * kDegree * normal(random);
  return r;
}

// The truth is inside the stated band 95 % of the time. Within a clip the coordinates of the
// keyframes are correlated, so the count scatters as that of a few numbers a clip.
TEST(Fit, StatesItsUncertainty) {
  const SagittalModel model = default_sagittal_model();
  int inside = 0, all = 0, period_inside = 0;
  constexpr int kClips = 20;
  for (unsigned seed = 1; seed <= kClips; ++seed) {
    fit::FitOptions options = known_scale_and_roll();
    options.harmonics = 3;
    fit::StrideFit truth;
    truth.runner = random_runner(seed);
    truth.harmonics = kMaxHarmonics;
    const Trajectory trajectory =
        synthetic_trajectory(truth.runner, model, {.duration_s = 2, .noise_px = 1.5, .seed = seed});
    const fit::Marks observations = fit::observe(trajectory, false);
    const fit::StrideFit fit = fit::fit_stride(observations, model, options);
    const CalibratedTrajectory run = gait::retarget(fit, gait::Gait{}, model, observations);
    for (std::size_t i = 0; i < run.samples.size(); i += 9) {
      const CalibratedSample& sample = run.samples[i];
      const double phase =
          phase_at(fit.runner.cadence.data(), sample.time_s - observations.middle_s);
      const CalibratedSample want = gait::pose_at(truth, model, phase);
      for (const BodyPart part :
           {BodyPart::knee_r, BodyPart::ankle_r, BodyPart::knee_l, BodyPart::ankle_l})
        for (const int axis : {0, 1}) {
          const double off = std::abs(sample[part][axis] - want[part][axis]);
          inside += off < 1.96 * sample.sd_m[index(part)][axis] ? 1 : 0;
          ++all;
        }
    }
    period_inside +=
        std::abs(fit.runner.cadence[cadence::period_s] - 0.69) < 1.96 * fit.period_sd_s() ? 1 : 0;
  }
  const double coverage = static_cast<double>(inside) / all;
  EXPECT_GT(coverage, 0.90);
  EXPECT_LT(coverage, 0.995);
  EXPECT_GE(period_inside, kClips * 85 / 100);
  RecordProperty("coverage", std::to_string(coverage));
}

}  // namespace
}  // namespace stride
