#include "calibrate/fit/solve.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "calibrate/fit/point_cost.h"
#include "calibrate/fit/residuals.h"
#include "extract/io/statistics.h"

namespace stride::fit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTukey = 4.685, kCauchy = 2.385;  // 95 % efficient under normal noise

template <typename Residual, int kResiduals, int... kBlocks>
ceres::CostFunction* cost(const FitProblem& problem, Residual residual) {
  if (problem.options.numeric_derivatives)
    return new ceres::NumericDiffCostFunction<Residual, ceres::CENTRAL, kResiduals, kBlocks...>(
        new Residual(std::move(residual)));
  return new ceres::AutoDiffCostFunction<Residual, kResiduals, kBlocks...>(
      new Residual(std::move(residual)));
}

/// The blocks that all frames share, in the order of `flattened`.
std::vector<std::pair<double*, int>> shared_blocks(Runner& r) {
  return {{r.camera.data(), 3}, {r.cadence.data(), 2}, {r.body.data(), 7},
          {r.sides.data(), 7},  {r.tilt.data(), 5},    {r.hip.data(), 13},
          {r.knee.data(), 13},  {r.ankle.data(), 13},  {r.asymmetry.data(), 9}};
}

/// A normal prior on the entries of a block.
template <std::size_t N>
void add_prior(ceres::Problem& ceres, std::array<double, N>& block,
               const std::array<Prior, N>& priors) {
  ceres::Matrix inverse_sd = ceres::Matrix::Zero(N, N);
  ceres::Vector mean(N);
  for (std::size_t i = 0; i < N; ++i) {
    inverse_sd(i, i) = 1 / priors[i].sd;
    mean[i] = priors[i].mean;
  }
  ceres.AddResidualBlock(new ceres::NormalPrior(inverse_sd, mean), nullptr, block.data());
}

/// Weak priors on any runner, which matter only where the points say nothing.
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
  ceres.AddResidualBlock(cost<HipsResidual, 2, 7>(problem, {1 * cm}), new ceres::CauchyLoss(1.5),
                         r.body.data());
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
    std::array<Prior, 2 * kMaxHarmonics + 1> priors;
    priors[0] = {0, 180 * kDegree};
    for (int h = 1; h <= kMaxHarmonics; ++h)
      priors[2 * h - 1] = priors[2 * h] = {0, 200 * kDegree / (h * h * h)};
    add_prior(ceres, *curve, priors);
  }
  std::array<Prior, 9> asymmetry;
  asymmetry.fill({0, 3 * kDegree});
  add_prior(ceres, r.asymmetry, asymmetry);

  if (!options.metres_per_pixel)
    ceres.AddResidualBlock(cost<LegLengthResidual, 1, 7>(problem, {leg, options.leg_m.sd}), nullptr,
                           r.body.data());
  ceres.AddResidualBlock(
      cost<ProportionResidual, 1, 7>(problem, {body::thigh, body::shank, 1, 0.15}), nullptr,
      r.body.data());
  ceres.AddResidualBlock(
      cost<ProportionResidual, 1, 7>(problem, {body::foot, body::shank, 0.47, 0.5}), nullptr,
      r.body.data());
}

void add_joint_limits(const FitProblem& problem, StrideFit& fit, ceres::Problem& ceres) {
  constexpr int kPhases = 24;
  const auto limit = [&](auto& curve, const SagittalModel::Range& range) {
    for (int i = 0; i < kPhases; ++i)
      ceres.AddResidualBlock(
          cost<JointLimitResidual, 1, 13>(
              problem, {fit.harmonics, static_cast<double>(i) / kPhases, range, 5 * kDegree}),
          nullptr, curve.data());
  };
  limit(fit.runner.hip, problem.model.hip);
  limit(fit.runner.knee, problem.model.knee);
  if (fit.toes_seen) limit(fit.runner.ankle, problem.model.ankle);
}

void add_marks(const FitProblem& problem, StrideFit& fit, Loss loss, ceres::Problem& ceres) {
  // Correlated points have less weight, but the loss scales each by its own noise.
  const double inflation = std::sqrt(fit.correlation), sigma = fit.sigma_px * inflation;
  Runner& r = fit.runner;
  auto robust = [&]() -> ceres::LossFunction* {
    if (loss == Loss::cauchy) return new ceres::CauchyLoss(kCauchy / inflation);
    return new ceres::TukeyLoss(kTukey * std::numbers::sqrt2 / inflation);  // of two coordinates
  };
  for (const Mark& mark : problem.observations.points) {
    double* pelvis = fit.pelvis_px[mark.frame].data();
    const double mark_sigma = sigma / std::sqrt(mark.weight);
    if (mark.part == BodyPart::pelvis) {
      ceres.AddResidualBlock(cost<PelvisResidual, 2, 2>(problem, {mark.z_px, mark_sigma}), robust(),
                             pelvis);
      continue;
    }
    const PointResidual residual{mark.part, problem.directions, fit.harmonics,
                                 mark.u_s,  mark.z_px,          mark_sigma};
    ceres.AddResidualBlock(
        problem.options.numeric_derivatives
            ? cost<PointResidual, 2, 3, 2, 7, 7, 5, 13, 13, 13, 9, 2>(problem, residual)
            : new PointCost(residual),
        robust(), r.camera.data(), r.cadence.data(), r.body.data(), r.sides.data(), r.tilt.data(),
        r.hip.data(), r.knee.data(), r.ankle.data(), r.asymmetry.data(), pelvis);
  }
}

void add_stance(const FitProblem& problem, StrideFit& fit, double* ground_m,
                ceres::Problem& ceres) {
  Runner& r = fit.runner;
  const auto n = static_cast<double>(problem.stance.phases.size());
  // Shoes bend and heels rise: a centimetre (2.5 for an ankle), weighted as if seen at three
  // phases.
  const double sd = (fit.toes_seen ? 0.010 : 0.025) * std::sqrt(std::max(n / 3, 1.0));
  for (const int side : {1, -1})
    for (const double own : problem.stance.phases) {
      const BodyPart part = side > 0 ? problem.stance.part_r : mirrored(problem.stance.part_r);
      const double phase = side > 0 ? own : own - 0.5;
      ceres.AddResidualBlock(cost<StanceResidual, 1, 7, 7, 5, 13, 13, 13, 9, 1>(
                                 problem, {part, problem.directions, fit.harmonics, phase,
                                           fit.vertical_oscillation(phase), sd}),
                             nullptr, r.body.data(), r.sides.data(), r.tilt.data(), r.hip.data(),
                             r.knee.data(), r.ankle.data(), r.asymmetry.data(), ground_m);
    }
}

void hold_what_is_not_asked(StrideFit& fit, ceres::Problem& ceres) {
  std::vector<int> unused;
  for (int i = 2 * fit.harmonics + 1; i < 2 * kMaxHarmonics + 1; ++i) unused.push_back(i);
  for (auto* curve : {&fit.runner.hip, &fit.runner.knee, &fit.runner.ankle}) {
    for (const int i : unused) (*curve)[i] = 0;
    if (!unused.empty())
      ceres.SetManifold(curve->data(), new ceres::SubsetManifold(2 * kMaxHarmonics + 1, unused));
  }
  if (!fit.toes_seen) ceres.SetParameterBlockConstant(fit.runner.ankle.data());
}

/// The problem at the current state; `ground_m` must outlive it.
void build(const FitProblem& problem, StrideFit& fit, Loss loss, double* ground_m,
           ceres::Problem& ceres) {
  for (const auto& [block, size] : shared_blocks(fit.runner)) ceres.AddParameterBlock(block, size);
  for (Eigen::Vector2d& pelvis : fit.pelvis_px) ceres.AddParameterBlock(pelvis.data(), 2);
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

/// Sets the pelvis of every frame to the median over its points, so one outlier has no effect.
void place_pelvis(const FitProblem& problem, StrideFit& fit) {
  std::vector<std::vector<double>> x(fit.pelvis_px.size()), y(fit.pelvis_px.size());
  for (Eigen::Vector2d& pelvis : fit.pelvis_px) pelvis.setZero();
  for (const Mark& mark : problem.observations.points) {
    if (mark.part == BodyPart::head) continue;
    const Eigen::Vector2d p =
        mark.z_px - predicted_px(fit, problem.directions, mark.part, mark.frame, mark.u_s);
    x[mark.frame].push_back(p.x());
    y[mark.frame].push_back(p.y());
  }
  Eigen::Vector2d previous = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < fit.pelvis_px.size(); ++i) {
    if (!x[i].empty()) previous = {median(x[i]), median(y[i])};
    fit.pelvis_px[i] = previous;
  }
}

}  // namespace

int max_harmonics(const Marks& observations, const Runner& runner) {
  constexpr int kBins = 4 * kMaxHarmonics;
  std::set<int> phases;
  for (const Mark& mark : observations.points) {
    if (mark.part != BodyPart::ankle_r && mark.part != BodyPart::ankle_l) continue;
    double phase = phase_at(runner.cadence.data(), mark.u_s);
    if (side_of(mark.part) < 0) phase += 0.5;
    phases.insert(static_cast<int>(kBins * (phase - std::floor(phase))));
  }
  return std::clamp((static_cast<int>(phases.size()) - 1) / 2, 2, kMaxHarmonics);
}

StrideFit start(const FitProblem& problem, const StridePeriod& guess) {
  StrideFit fit;
  const Marks& all = problem.observations;
  fit.toes_seen = all.sees(BodyPart::toe_r) || all.sees(BodyPart::toe_l);
  fit.head_seen = all.sees(BodyPart::head);
  fit.explained = guess.explained;
  fit.harmonics = problem.options.harmonics > 0 ? problem.options.harmonics : 3;
  fit.runner = guess_runner(all, problem.model, guess.period_s, problem.options.leg_m.mean);
  if (problem.options.metres_per_pixel) {
    const double px_per_m = 1 / *problem.options.metres_per_pixel;
    const double ratio = std::exp(fit.runner.camera[camera::log_px_per_m]) / px_per_m;
    fit.runner.camera[camera::log_px_per_m] = std::log(px_per_m);
    for (const int i : {body::thigh, body::shank, body::foot, body::trunk})
      fit.runner.body[i] *= ratio;
  }
  fit.backward = fit.runner.knee[0] > 0;  // before the joint limits exclude it
  fit.runner.tilt[0] = -4 * kDegree;
  fit.runner.hip[0] += 4 * kDegree;
  fit.pelvis_px.assign(all.u_s.size(), Eigen::Vector2d::Zero());
  place_pelvis(problem, fit);
  estimate_noise(problem, fit);
  return fit;
}

Solution solve(const FitProblem& problem, StrideFit& fit, Loss loss, double tolerance) {
  double ground_m = -(fit.runner.body[body::thigh] + fit.runner.body[body::shank]);
  ceres::Problem ceres;
  build(problem, fit, loss, &ground_m, ceres);
  auto* order = new ceres::ParameterBlockOrdering;
  for (Eigen::Vector2d& pelvis : fit.pelvis_px) order->AddElementToGroup(pelvis.data(), 0);
  for (const auto& [block, size] : shared_blocks(fit.runner)) order->AddElementToGroup(block, 1);
  if (!problem.stance.phases.empty()) order->AddElementToGroup(&ground_m, 1);
  ceres::Solver::Options options;
  options.linear_solver_ordering.reset(order);
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 60;
  options.function_tolerance = tolerance;
  options.parameter_tolerance = 1e-11;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres, &summary);
  fit.ok = summary.IsSolutionUsable();
  if (!fit.ok) fit.failure = "the fit does not converge: " + summary.message;
  fit.iterations += static_cast<int>(summary.iterations.size());
  return {summary.final_cost};
}

void estimate_noise(const FitProblem& problem, StrideFit& fit) {
  constexpr double kLeastSigma = 1e-6;  // px: marks without noise
  const auto& points = problem.observations.points;
  fit.marks.assign(points.size(), {});
  std::vector<double> absolute;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Mark& mark = points[i];
    MarkResidual& residual = fit.marks[i];
    residual.r_px =
        mark.z_px - predicted_px(fit, problem.directions, mark.part, mark.frame, mark.u_s);
    absolute.push_back(std::abs(residual.r_px.x()) * std::sqrt(mark.weight));
    absolute.push_back(std::abs(residual.r_px.y()) * std::sqrt(mark.weight));
  }
  const double parameters =
      2.0 * static_cast<double>(fit.pelvis_px.size()) + 30 + 6 * fit.harmonics;
  const double marks = static_cast<double>(absolute.size());
  const double freedom = std::max(0.2, 1 - parameters / marks);
  const double seen = std::max(kLeastSigma, 1.4826 * median(absolute) / std::sqrt(freedom));
  const double own = problem.options.mark_sd * leg_px(fit.runner);
  fit.sigma_px = std::max(seen, own);

  double sum = 0, count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double size = fit.marks[i].r_px.norm() * std::sqrt(points[i].weight);
    fit.marks[i].outlier = size > kTukey * fit.sigma_px * std::numbers::sqrt2;
    if (fit.marks[i].outlier) continue;
    sum += fit.marks[i].r_px.squaredNorm();
    ++count;
  }
  fit.rms_px = std::sqrt(sum / std::max(count, 1.0));
  fit.outlier_fraction = 1 - count / static_cast<double>(std::max<std::size_t>(points.size(), 1));

  // Correlation of the residuals of a part in neighbouring frames.
  std::array<std::vector<Eigen::Vector2d>, kBodyPartCount> series;
  for (auto& each : series)
    each.assign(fit.pelvis_px.size(), Eigen::Vector2d::Constant(std::nan("")));
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!fit.marks[i].outlier)
      series[index(points[i].part)][points[i].frame] =
          fit.marks[i].r_px * std::sqrt(points[i].weight);
  double alike = 1, variance = 0;
  for (int lag = 0; lag < 12; ++lag) {
    double product = 0, pairs = 0;
    for (const auto& each : series)
      for (std::size_t i = 0; i + lag < each.size(); ++i) {
        const double value = each[i].dot(each[i + lag]);
        if (!std::isnan(value)) product += value, ++pairs;
      }
    if (pairs < 20) break;
    const double mean = product / pairs;
    if (lag == 0) variance = std::max(mean, 1e-30);
    if (lag > 0 && mean < 0.1 * variance) break;
    if (lag > 0) alike += 2 * mean / variance;
  }
  // A smoothing tracker hides the noise of its clicks. The hidden part is that of eight clicks of
  // each part a stride, however many frames are interpolated between them.
  const double strides = problem.observations.duration_s / fit.runner.cadence[cadence::period_s];
  const double frames = problem.observations.count[index(BodyPart::ankle_r)];
  const double copies = std::max(1.0, frames / (8 * std::max(strides, 1.0)));
  const double hidden = std::max(0.0, own * own - seen * seen);
  fit.correlation = (alike * seen * seen + copies * hidden) / (fit.sigma_px * fit.sigma_px);
}

void estimate_covariance(const FitProblem& problem, StrideFit& fit) {
  double ground_m = -(fit.runner.body[body::thigh] + fit.runner.body[body::shank]);
  ceres::Problem ceres;
  build(problem, fit, Loss::tukey, &ground_m, ceres);
  ceres::Problem::EvaluateOptions options;
  std::vector<int> column;  // of `flattened` for every column of the Jacobian; −1: the ground
  int offset = 0;
  for (const auto& [block, size] : shared_blocks(fit.runner)) {
    const bool curve = size == 2 * kMaxHarmonics + 1;
    const int free = curve ? 2 * fit.harmonics + 1 : size;
    if (!ceres.IsParameterBlockConstant(block)) {
      options.parameter_blocks.push_back(block);
      for (int i = 0; i < free; ++i) column.push_back(offset + i);
    }
    offset += size;
  }
  if (!problem.stance.phases.empty()) {
    options.parameter_blocks.push_back(&ground_m);
    column.push_back(-1);
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
  const Eigen::MatrixXd inverse = s.completeOrthogonalDecomposition().pseudoInverse();
  fit.covariance = Eigen::MatrixXd::Zero(offset, offset);
  for (int i = 0; i < shared; ++i)
    for (int j = 0; j < shared; ++j)
      if (column[i] >= 0 && column[j] >= 0) fit.covariance(column[i], column[j]) = inverse(i, j);
}

}  // namespace stride::fit
