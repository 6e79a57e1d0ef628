#include "calibrate/aperiodic/passage_fit.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "calibrate/aperiodic/residuals.h"
#include "calibrate/aperiodic/start.h"
#include "calibrate/fit/solver/problem.h"
#include "calibrate/fit/solver/residuals.h"
#include "extract/io/statistics.h"
#include "extract/skeleton/least_squares.h"
#include "extract/skeleton/robust_fit.h"
#include "extract/skeleton/units.h"

namespace stride::aperiodic {
namespace {

constexpr std::array kKnots_s{0.30, 0.22, 0.16, 0.12, 0.09};

struct Problem {
  const fit::Marks& marks;
  const SagittalModel& model;
  Directions directions;
  Legs legs;
  double mark_sd;
};

template <int kResiduals, int... kBlocks, typename Residual>
ceres::CostFunction* automatic(Residual residual) {
  return new ceres::AutoDiffCostFunction<Residual, kResiduals, kBlocks...>(
      new Residual(std::move(residual)));
}

void add_marks(const Problem& problem, PassageFit& fit, fit::Loss loss, ceres::Problem& ceres) {
  const double inflation = std::sqrt(fit.correlation), sigma = fit.sigma_px * inflation;
  const auto robust = [&]() -> ceres::LossFunction* {
    if (loss == fit::Loss::cauchy) return new ceres::CauchyLoss(fit::kCauchy / inflation);
    return new ceres::TukeyLoss(fit::kTukey * std::numbers::sqrt2 / inflation);
  };
  Passage& p = fit.passage;
  for (const fit::Mark& mark : problem.marks.points) {
    double* pelvis = p.pelvis_px[static_cast<std::size_t>(mark.frame)].data();
    const double own = sigma / std::sqrt(mark.weight);
    if (mark.part == BodyPart::pelvis) {
      ceres.AddResidualBlock(automatic<2, 2>(fit::PelvisResidual{mark.z_px, own}), robust(),
                             pelvis);
      continue;
    }
    const SplinePlace at = p.place(mark.u_s);
    double* const c = p.knots[static_cast<std::size_t>(at.first)].data();
    ceres.AddResidualBlock(
        automatic<2, limb::size, kAngles, kAngles, kAngles, kAngles, 2>(
            PassagePointResidual{mark.part, problem.directions, at.weight, mark.z_px, own}),
        robust(), p.limbs.data(), c, c + kAngles, c + 2 * kAngles, c + 3 * kAngles, pelvis);
  }
}

void add_priors(const Problem& problem, PassageFit& fit, ceres::Problem& ceres) {
  // Angular accelerations of a jump: knees to 4000°/s², the trunk to 1000°/s².
  constexpr double kLegs_rad_s2 = 6000 * kDegree, kTrunk_rad_s2 = 1500 * kDegree;
  Passage& p = fit.passage;
  BendResidual bend;
  bend.sd_rad.fill(kLegs_rad_s2 * p.knot_s * p.knot_s);
  bend.sd_rad[tilt] = kTrunk_rad_s2 * p.knot_s * p.knot_s;
  for (std::size_t k = 1; k + 1 < p.knots.size(); ++k)
    ceres.AddResidualBlock(automatic<kAngles, kAngles, kAngles, kAngles>(bend), nullptr,
                           p.knots[k - 1].data(), p.knots[k].data(), p.knots[k + 1].data());
  const auto range = [](const SagittalModel::Range& r) {
    return PostureResidual::Range{r.min, r.max};
  };
  const SagittalModel& model = problem.model;
  // Where the head is not marked nothing tells how the trunk leans.
  const PostureResidual posture{
      .joints = {range(model.hip), range(model.knee), range(model.ankle)},
      .limit_sd_rad = 5 * kDegree,
      .tilt_mean_rad = -10 * kDegree,
      .tilt_sd_rad = (fit.head_seen ? 60 : 12) * kDegree,
      .legs_sd_rad = (problem.legs == Legs::together ? 4 : 1000) * kDegree};
  for (Angles& knot : p.knots)
    ceres.AddResidualBlock(automatic<10, kAngles>(posture), nullptr, knot.data());
  ceres.AddResidualBlock(automatic<4, limb::size>(LimbsResidual{}), nullptr, p.limbs.data());
}

void build(const Problem& problem, PassageFit& fit, fit::Loss loss, ceres::Problem& ceres) {
  Passage& p = fit.passage;
  ceres.AddParameterBlock(p.limbs.data(), limb::size);
  for (Angles& knot : p.knots) ceres.AddParameterBlock(knot.data(), kAngles);
  for (Eigen::Vector2d& pelvis : p.pelvis_px) ceres.AddParameterBlock(pelvis.data(), 2);
  add_marks(problem, fit, loss, ceres);
  add_priors(problem, fit, ceres);
  for (const int length : {limb::thigh, limb::shank, limb::foot, limb::trunk})
    ceres.SetParameterLowerBound(p.limbs.data(), length, 1);
}

double solve(const Problem& problem, PassageFit& fit, fit::Loss loss, double tolerance) {
  ceres::Problem ceres;
  build(problem, fit, loss, ceres);
  auto* order = new ceres::ParameterBlockOrdering;
  for (Eigen::Vector2d& pelvis : fit.passage.pelvis_px) order->AddElementToGroup(pelvis.data(), 0);
  for (Angles& knot : fit.passage.knots) order->AddElementToGroup(knot.data(), 1);
  order->AddElementToGroup(fit.passage.limbs.data(), 1);
  ceres::Solver::Options options;
  options.linear_solver_ordering.reset(order);
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 60;
  options.function_tolerance = tolerance;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres, &summary);
  fit.ok = summary.IsSolutionUsable();
  if (!fit.ok) fit.failure = "the fit does not converge: " + summary.message;
  return summary.final_cost;
}

/// Residuals, outliers, the robust standard deviation of a mark, and how much frames repeat one
/// another: a tracker makes every frame of the clicks beside it.
void estimate_noise(const Problem& problem, PassageFit& fit) {
  const auto& points = problem.marks.points;
  fit.marks.assign(points.size(), {});
  std::vector<double> absolute;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const fit::Mark& mark = points[i];
    fit.marks[i].r_px =
        mark.z_px - predicted_px(fit.passage, problem.directions, mark.part, mark.frame, mark.u_s);
    for (const double r : fit.marks[i].r_px)
      absolute.push_back(std::abs(r) * std::sqrt(mark.weight));
  }
  const double own = problem.mark_sd * fit.passage.leg_px();
  fit.seen_px = kSigmaPerMedian * median(absolute);
  fit.sigma_px = std::max(fit.seen_px, own);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double size = fit.marks[i].r_px.norm() * std::sqrt(points[i].weight);
    fit.marks[i].outlier = size > fit::kTukey * fit.sigma_px * std::numbers::sqrt2;
    if (fit.marks[i].outlier) continue;
    sum += fit.marks[i].r_px.squaredNorm();
    ++count;
  }
  fit.rms_px = std::sqrt(sum / std::max(count, 1.0));
  fit.outlier_fraction = 1 - count / static_cast<double>(std::max<std::size_t>(points.size(), 1));
  // Clicks at the paper's rate are 0.086 s apart.
  constexpr double kClicks_s = 0.086;
  const double frame_s = problem.marks.duration_s /
                         std::max<double>(1, static_cast<double>(problem.marks.u_s.size() - 1));
  fit.correlation = std::max(1.0, kClicks_s / frame_s);
}

void settle(const Problem& problem, PassageFit& fit, fit::Loss loss, int rounds, double tolerance) {
  for (int round = 0; round < rounds; ++round) {
    const double before = fit.sigma_px;
    solve(problem, fit, loss, tolerance);
    estimate_noise(problem, fit);
    if (std::abs(fit.sigma_px - before) < 0.02 * before) break;
  }
}

/// Akaike's criterion at a noise level: the cost, plus two for each parameter of the angles.
double information(const fit::Marks& marks, const PassageFit& fit, double noise_px) {
  double cost = 0;
  for (std::size_t i = 0; i < fit.marks.size(); ++i)
    cost +=
        std::min(fit.marks[i].r_px.squaredNorm() * marks.points[i].weight / (noise_px * noise_px),
                 fit::kTukey * fit::kTukey) /
        fit.correlation;
  return cost + 2.0 * static_cast<double>(kAngles * fit.passage.knots.size());
}

/// (JᵀJ)⁻¹ at the solution, the pelvis of every frame eliminated.
void estimate_covariance(const Problem& problem, PassageFit& fit) {
  ceres::Problem ceres;
  build(problem, fit, fit::Loss::tukey, ceres);
  Passage& p = fit.passage;
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks.push_back(p.limbs.data());
  for (Angles& knot : p.knots) options.parameter_blocks.push_back(knot.data());
  for (Eigen::Vector2d& pelvis : p.pelvis_px) options.parameter_blocks.push_back(pelvis.data());
  ceres::CRSMatrix jacobian;
  ceres.Evaluate(options, nullptr, nullptr, nullptr, &jacobian);
  const auto all = static_cast<Eigen::Index>(jacobian.num_cols);
  const auto shared = static_cast<Eigen::Index>(limb::size + kAngles * p.knots.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(all, all);
  for (int row = 0; row < jacobian.num_rows; ++row)
    for (int a = jacobian.rows[row]; a < jacobian.rows[row + 1]; ++a)
      for (int b = jacobian.rows[row]; b < jacobian.rows[row + 1]; ++b)
        normal(jacobian.cols[a], jacobian.cols[b]) += jacobian.values[a] * jacobian.values[b];
  Eigen::MatrixXd s = normal.topLeftCorner(shared, shared);
  for (Eigen::Index i = shared; i < all; i += 2) {
    const Eigen::Matrix2d v = normal.block<2, 2>(i, i);
    if (!(v.determinant() > 0)) continue;
    const Eigen::MatrixXd w = normal.block(0, i, shared, 2);
    s -= w * v.inverse() * w.transpose();
  }
  fit.covariance = pseudo_inverse(s);
}

}  // namespace

PassageFit fit_passage(const fit::Marks& observations, const SagittalModel& model, Legs legs,
                       double mark_sd) {
  const Problem problem{observations, model, Directions(model), legs, mark_sd};
  PassageFit best;
  best.failure = "too few marks of pelvis, knees and ankles";
  if (observations.u_s.size() < 8) return best;
  std::vector<PassageFit> fits;
  for (const double knot_s : kKnots_s) {
    PassageFit fit = start(observations, problem.directions, knot_s);
    if (!fit.failure.empty()) return fit;
    estimate_noise(problem, fit);
    settle(problem, fit, fit::Loss::cauchy, 2, 1e-4);
    settle(problem, fit, fit::Loss::tukey, 3, 1e-5);
    if (fit.ok) fits.push_back(std::move(fit));
  }
  if (fits.empty()) return best;
  // At the noise that the finest leaves, which is the same for all.
  const double noise_px = fits.back().seen_px;
  double least = std::numeric_limits<double>::infinity();
  for (PassageFit& fit : fits) {
    const double value = information(observations, fit, noise_px);
    if (value < least) best = fit, least = value;
  }
  if (!best.ok) return best;
  settle(problem, best, fit::Loss::tukey, 4, 1e-9);
  estimate_covariance(problem, best);
  return best;
}

}  // namespace stride::aperiodic
