#include "calibrate/fit.h"

#include <algorithm>
#include <cmath>

#include "calibrate/bounce.h"
#include "calibrate/first_guess.h"
#include "calibrate/solve.h"
#include "calibrate/stance.h"

namespace stride {
namespace {

constexpr double kCoarse = 1e-4, kFine = 1e-9;  // relative decrease of the cost

/// Akaike's information criterion, which predicts as leaving marks out one by one does: the cost at
/// one and the same noise, and one for each parameter.
double information(const Solution& solution, const StrideFit& fit) {
  return 2 * solution.cost + 2 * 3 * (2 * fit.harmonics + 1);
}

/// Frames in a sixth of a stride: what lasts longer is a harmonic that is missing, not noise.
double longest_correlation(const StrideFit& fit, const Marks& observations) {
  const double frames_per_s =
      static_cast<double>(observations.u_s.size() - 1) / observations.duration_s;
  return std::max(1.0, fit.runner.cadence[cadence::period_s] * frames_per_s / 6);
}

/// Fit and noise in turn, until the noise changes no more.
void settle(const FitProblem& problem, StrideFit& fit, Loss loss, int rounds, double tolerance) {
  for (int round = 0; round < rounds; ++round) {
    const double before = fit.sigma_px;
    solve(problem, fit, loss, tolerance);
    estimate_noise(problem, fit);
    if (std::abs(fit.sigma_px - before) < 0.02 * before) break;
  }
}

}  // namespace

StrideFit fit_stride(const Marks& observations, const SagittalModel& model,
                     const FitOptions& options) {
  FitProblem problem{observations, model, Directions(model), options, {}};
  StrideFit best;
  best.failure = "no stride repeats: too few marks of pelvis, knees and ankles";
  // Several starts: a stride that is right explains more than a third of it or three of them.
  for (const StridePeriod& guess : guess_periods(observations, 3)) {
    StrideFit fit = start(problem, guess);
    settle(problem, fit, Loss::cauchy, 2, kCoarse);
    if (fit.ok && (!best.ok || fit.sigma_px < 0.9 * best.sigma_px)) best = std::move(fit);
  }
  if (!best.ok) return best;

  settle(problem, best, Loss::tukey, 3, kCoarse);
  if (options.harmonics == 0) {
    // From many to few at the noise of the richest: what each harmonic buys must outweigh it.
    StrideFit richest = best;
    richest.harmonics = max_harmonics(observations, best.runner);
    settle(problem, richest, Loss::tukey, 3, kCoarse);
    richest.correlation = std::min(richest.correlation, longest_correlation(richest, observations));
    double least = std::numeric_limits<double>::infinity();
    for (StrideFit fit = richest; fit.harmonics >= 2; --fit.harmonics) {
      const Solution solution = solve(problem, fit, Loss::tukey, kCoarse);
      const double value = information(solution, fit);
      if (value < least) best = fit, least = value;
    }
  }
  // The roll of the camera shows in the feet that stand: they keep their height.
  for (int round = 0; round < 2; ++round) {
    best.bounce = measure_bounce(best, observations);
    const BodyPart part = best.toes_seen ? BodyPart::toe_r : BodyPart::ankle_r;
    problem.stance = {part, find_stance(best, problem.directions, part).phases};
    settle(problem, best, Loss::tukey, 4, round == 0 ? kCoarse : kFine);
  }
  best.bounce = measure_bounce(best, observations);
  estimate_covariance(problem, best);
  return best;
}

Eigen::Vector2d about_pelvis_px(const StrideFit& fit, const Directions& directions, BodyPart part,
                                double u_s) {
  const Runner& r = fit.runner;
  const double phase = phase_at(r.cadence.data(), u_s);
  const auto leg = leg_angles(r.hip.data(), r.knee.data(), r.ankle.data(), r.asymmetry.data(),
                              fit.harmonics, side_of(part) < 0 ? -1 : 1, phase);
  const Eigen::Vector2d q = place_part(part, directions, r.body.data(), r.sides.data(),
                                       evaluate_series(r.tilt.data(), 2, phase), leg, phase);
  const double scale =
      std::exp(r.camera[camera::log_px_per_m] + r.camera[camera::drift_per_s] * u_s);
  return scale * turned(r.camera[camera::roll], q);
}

Eigen::Vector2d predicted_px(const StrideFit& fit, const Directions& directions, BodyPart part,
                             int frame, double u_s) {
  return fit.pelvis_px[frame] + about_pelvis_px(fit, directions, part, u_s);
}

Eigen::VectorXd propagated_sd(const StrideFit& fit,
                              const std::function<Eigen::VectorXd(const StrideFit&)>& values) {
  const Eigen::VectorXd at = flattened(fit.runner);
  StrideFit moved;
  moved.harmonics = fit.harmonics;
  moved.bounce = fit.bounce;
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(values(fit).size(), at.size());
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    const double sd = std::sqrt(fit.covariance(k, k));
    if (!(sd > 0)) continue;
    const double h = 1e-3 * std::min(sd, 1.0);  // central differences within a thousandth of sd
    const auto value = [&](double way) {
      Eigen::VectorXd there = at;
      there[k] += way * h;
      moved.runner = unflattened(there);
      return values(moved);
    };
    jacobian.col(k) = (value(1) - value(-1)) / (2 * h);
  }
  return (jacobian * fit.covariance * jacobian.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
}

Eigen::VectorXd flattened(const Runner& r) {
  std::vector<double> all;
  const auto append = [&](const auto& block) { all.insert(all.end(), block.begin(), block.end()); };
  append(r.camera), append(r.cadence), append(r.body), append(r.sides), append(r.tilt);
  append(r.hip), append(r.knee), append(r.ankle), append(r.asymmetry);
  return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

Runner unflattened(const Eigen::VectorXd& values) {
  Runner r;
  const double* from = values.data();
  const auto take = [&](auto& block) {
    std::copy_n(from, block.size(), block.begin());
    from += block.size();
  };
  take(r.camera), take(r.cadence), take(r.body), take(r.sides), take(r.tilt);
  take(r.hip), take(r.knee), take(r.ankle), take(r.asymmetry);
  return r;
}

double StrideFit::period_sd_s() const {
  constexpr int i = 3 + cadence::period_s;
  return std::sqrt(covariance(i, i));
}

double StrideFit::scale_relative_sd() const {
  return std::sqrt(covariance(camera::log_px_per_m, camera::log_px_per_m));
}

double StrideFit::roll_sd_rad() const { return std::sqrt(covariance(camera::roll, camera::roll)); }

}  // namespace stride
