#include "calibrate/fit/solver/problem.h"

#include <ceres/loss_function.h>
#include <ceres/manifold.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/fit/solver/add_residual.h"
#include "calibrate/fit/solver/point_cost.h"
#include "extract/skeleton/units.h"

namespace stride::fit {
namespace {

void add_joint_limits(const FitProblem& problem, StrideFit& fit, ceres::Problem& ceres) {
  constexpr int kPhases = 24;
  const auto limit = [&](auto& curve, const SagittalModel::Range& range) {
    for (int i = 0; i < kPhases; ++i)
      add_residual(
          ceres, problem.options.numeric_derivatives, fit.runner,
          JointLimitResidual{fit.harmonics, static_cast<double>(i) / kPhases, range, 5 * kDegree},
          nullptr, curve.data());
  };
  limit(fit.runner.hip, problem.model.hip);
  limit(fit.runner.knee, problem.model.knee);
  if (fit.toes_seen) limit(fit.runner.ankle, problem.model.ankle);
}

/// Times the noise of other points. A network's heel is off as its ankle is: with the say of other
/// points heels make knees and ankles worse.
constexpr double kHeelNoise = 3;

void add_marks(const FitProblem& problem, StrideFit& fit, Loss loss, ceres::Problem& ceres) {
  // Correlated points have less weight, but the loss scales each by its own noise.
  const double inflation = std::sqrt(fit.correlation), sigma = fit.sigma_px * inflation;
  auto robust = [&]() -> ceres::LossFunction* {
    if (loss == Loss::cauchy) return new ceres::CauchyLoss(kCauchy / inflation);
    return new ceres::TukeyLoss(kTukey * std::numbers::sqrt2 / inflation);  // of two coordinates
  };
  const bool numeric = problem.options.numeric_derivatives;
  for (const Mark& mark : problem.observations.points) {
    double* pelvis = fit.pelvis_px[mark.frame].data();
    const double mark_sigma = sigma / std::sqrt(mark.weight);
    if (mark.part == BodyPart::pelvis) {
      add_residual(ceres, numeric, fit.runner, PelvisResidual{mark.z_px, mark_sigma}, robust(),
                   pelvis);
      continue;
    }
    const auto add = [&](ceres::CostFunction* cost, const std::vector<double*>& blocks) {
      ceres.AddResidualBlock(numeric ? numeric_derivatives_of(cost) : cost, robust(), blocks);
    };
    if (is_heel(mark.part))
      add(new HeelCost({mark.part, problem.directions, fit.harmonics, mark.u_s, mark.z_px,
                        kHeelNoise * mark_sigma}),
          HeelResidual::DependsOn::of(fit.runner, pelvis, fit.heel.data()));
    else
      add(new PointCost(
              {mark.part, problem.directions, fit.harmonics, mark.u_s, mark.z_px, mark_sigma}),
          PointResidual::DependsOn::of(fit.runner, pelvis));
  }
}

void add_stance(const FitProblem& problem, StrideFit& fit, double* ground_m,
                ceres::Problem& ceres) {
  const auto n = static_cast<double>(problem.stance.phases.size());
  // Shoes bend and heels rise: a centimetre (2.5 for an ankle), weighted as if seen at three
  // phases.
  const double sd = (fit.toes_seen ? 0.010 : 0.025) * std::sqrt(std::max(n / 3, 1.0));
  for (const int side : {1, -1})
    for (const double own : problem.stance.phases) {
      const BodyPart part = side > 0 ? problem.stance.part_r : mirrored(problem.stance.part_r);
      const double phase = side > 0 ? own : own - 0.5;
      add_residual(ceres, problem.options.numeric_derivatives, fit.runner,
                   StanceResidual{part, problem.directions, fit.harmonics, phase,
                                  fit.vertical_oscillation(phase), sd},
                   nullptr, ground_m);
    }
}

void hold_what_is_not_asked(StrideFit& fit, ceres::Problem& ceres) {
  std::vector<int> unused;
  for (int i = 2 * fit.harmonics + 1; i < kSizeOf<&Runner::hip>; ++i) unused.push_back(i);
  for (auto* curve : {&fit.runner.hip, &fit.runner.knee, &fit.runner.ankle}) {
    for (const int i : unused) (*curve)[i] = 0;
    if (!unused.empty())
      ceres.SetManifold(curve->data(), new ceres::SubsetManifold(kSizeOf<&Runner::hip>, unused));
  }
  if (!fit.toes_seen) ceres.SetParameterBlockConstant(fit.runner.ankle.data());
}

}  // namespace

double first_ground_m(const Runner& runner) {
  return -(runner.body[body::thigh] + runner.body[body::shank]);
}

std::array<double, heel::size> usual_heel(const FitProblem& problem) {
  const SagittalModel& model = problem.model;
  const Eigen::Vector2d p_m =
      problem.options.leg_m.mean / (model.thigh_m() + model.shank_m()) * model.p_talus_heel_m;
  return {p_m.x(), p_m.y()};
}

void build(const FitProblem& problem, StrideFit& fit, Loss loss, double* ground_m,
           ceres::Problem& ceres) {
  for_each_block(fit.runner, [&](auto& block) {
    ceres.AddParameterBlock(block.data(), static_cast<int>(block.size()));
  });
  for (Eigen::Vector2d& pelvis : fit.pelvis_px) ceres.AddParameterBlock(pelvis.data(), 2);
  if (fit.heels_seen) ceres.AddParameterBlock(fit.heel.data(), heel::size);
  add_marks(problem, fit, loss, ceres);
  add_priors(problem, fit, ceres);
  add_joint_limits(problem, fit, ceres);
  add_stance(problem, fit, ground_m, ceres);
  hold_what_is_not_asked(fit, ceres);
  double* body = fit.runner.body.data();
  for (const int length : {body::thigh, body::shank, body::foot, body::trunk})
    ceres.SetParameterLowerBound(body, length, 0.01 * problem.options.leg_m.mean);
  ceres.SetParameterLowerBound(fit.runner.cadence.data(), cadence::period_s, 0.1);
  // Bounds keep exponentials from overflowing.
  double* camera = fit.runner.camera.data();
  const double log_scale = camera[camera::log_px_per_m];
  ceres.SetParameterLowerBound(camera, camera::log_px_per_m, log_scale - 3);
  ceres.SetParameterUpperBound(camera, camera::log_px_per_m, log_scale + 3);
}

}  // namespace stride::fit
