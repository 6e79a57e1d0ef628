#include <ceres/loss_function.h>
#include <ceres/normal_prior.h>

#include <algorithm>
#include <cmath>

#include "calibrate/fit/solver/add_residual.h"
#include "calibrate/fit/solver/problem.h"
#include "extract/skeleton/units.h"

namespace stride::fit {
namespace {

/// A normal prior on the entries of a block. An entry without one does not compile.
template <std::size_t N>
void add_prior(ceres::Problem& ceres, std::array<double, N>& block, const Prior (&priors)[N]) {
  ceres::Matrix inverse_sd = ceres::Matrix::Zero(N, N);
  ceres::Vector mean(N);
  for (std::size_t i = 0; i < N; ++i) {
    inverse_sd(i, i) = 1 / priors[i].sd;
    mean[i] = priors[i].mean;
  }
  ceres.AddResidualBlock(new ceres::NormalPrior(inverse_sd, mean), nullptr, block.data());
}

}  // namespace

void add_priors(const FitProblem& problem, StrideFit& fit, ceres::Problem& ceres) {
  Runner& r = fit.runner;
  const FitOptions& options = problem.options;
  const double leg = options.leg_m.mean, cm = 0.01 * leg / 0.85, wide = 1e3;
  const double roll = problem.observations.to_left ? -options.roll_rad.mean : options.roll_rad.mean;
  const Prior scale =
      options.metres_per_pixel ? Prior{-std::log(*options.metres_per_pixel), 1e-4} : Prior{0, wide};
  add_prior(ceres, r.camera, {scale, Prior{0, 0.05}, Prior{roll, options.roll_rad.sd}});
  // Cadence holds within 3 % over the clip.
  const double period = r.cadence[cadence::period_s],
               span = std::max(problem.observations.duration_s, period);
  add_prior(ceres, r.cadence, {Prior{period, wide}, Prior{0, 0.03 / (period * span)}});
  // The trunk leans with the pelvis. The labelled pelvis is the midpoint of the hips within 1 cm;
  // Cauchy's loss allows for larger offsets.
  const bool numeric = options.numeric_derivatives;
  add_residual(ceres, numeric, r, HipsResidual{1 * cm}, new ceres::CauchyLoss(1.5));
  add_prior(ceres, r.body,
            {Prior{0, wide}, Prior{0, wide}, Prior{0, wide}, Prior{0.87 * leg, 0.3 * leg},
             Prior{0, wide}, Prior{0, wide}, Prior{0, 4 * kDegree}});
  // Hips turn and drop by a centimetre; a leg is 10 cm nearer to a camera at 4 m or more.
  add_prior(ceres, r.sides,
            {Prior{0, 0.025}, Prior{0, cm}, Prior{0, cm}, Prior{0, cm}, Prior{0, cm},
             Prior{0, 0.7 * cm}, Prior{0, 0.7 * cm}});
  // Tilt of two measured runners: mean −1.2° (Hamner 2010), −6.7° (Rajagopal 2016); once a stride
  // by 0.3 to 0.4°, once a step by 1.3 to 3.4°.
  const double stride = 0.5 * kDegree, step = 2 * kDegree;
  add_prior(ceres, r.tilt,
            {Prior{-4 * kDegree, 4 * kDegree}, Prior{0, stride}, Prior{0, stride}, Prior{0, step},
             Prior{0, step}});
  // Measured and animated runners: to 36° at the first harmonic, 29° at the second, 8, 3, 1, 1.
  // This prior matters where every stride was clicked at the same few phases.
  for (auto* curve : {&r.hip, &r.knee, &r.ankle}) {
    Prior priors[kSizeOf<&Runner::hip>];
    priors[0] = {0, 180 * kDegree};
    for (int h = 1; h <= kMaxHarmonics; ++h)
      priors[2 * h - 1] = priors[2 * h] = {0, 200 * kDegree / (h * h * h)};
    add_prior(ceres, *curve, priors);
  }
  Prior asymmetry[asymmetry::size];
  std::ranges::fill(asymmetry, Prior{0, 3 * kDegree});
  add_prior(ceres, r.asymmetry, asymmetry);

  if (fit.heels_seen) {
    // The back of a shoe is 3 cm behind the model's calcn, and networks differ by as much.
    const auto usual = usual_heel(problem);
    add_prior(ceres, fit.heel,
              {Prior{usual[heel::forward], 3 * cm}, Prior{usual[heel::up], 3 * cm}});
  }
  if (const auto& measured = options.measured_scale) {
    // e^(s + ṡu) px per m at its moment
    ceres::Matrix at(1, camera::size);
    at << 1, measured->u_s, 0;
    ceres::Vector mean(camera::size);
    mean << -std::log(measured->metres_per_pixel), 0, 0;
    ceres.AddResidualBlock(new ceres::NormalPrior(at / measured->relative_sd, mean), nullptr,
                           r.camera.data());
  }
  if (!options.metres_per_pixel && !options.measured_scale)
    add_residual(ceres, numeric, r, LegLengthResidual{leg, options.leg_m.sd}, nullptr);
  add_residual(ceres, numeric, r, ProportionResidual{body::thigh, body::shank, 1, 0.15}, nullptr);
  add_residual(ceres, numeric, r, ProportionResidual{body::foot, body::shank, 0.47, 0.5}, nullptr);
}

}  // namespace stride::fit
