#include "calibrate/fit/fit.h"

#include <algorithm>
#include <cmath>

#include "calibrate/fit/solver/noise.h"
#include "calibrate/fit/solver/solve.h"
#include "calibrate/fit/stance.h"
#include "calibrate/fit/start.h"
#include "calibrate/fit/vertical_oscillation.h"

namespace stride::fit {
namespace {

constexpr double kCoarse = 1e-4, kFine = 1e-9;  // relative decrease of the cost

/// Akaike's information criterion, an approximation of leave-one-out cross-validation: the cost at
/// a fixed noise level, plus one for each parameter.
double information(const Solution& solution, const StrideFit& fit) {
  return 2 * solution.cost + 2 * 3 * (2 * fit.harmonics + 1);
}

/// Frames in a sixth of a stride: longer correlations are a missing harmonic, not noise.
double longest_correlation(const StrideFit& fit, const Marks& observations) {
  const double frames_per_s =
      static_cast<double>(observations.u_s.size() - 1) / observations.duration_s;
  return std::max(1.0, fit.runner.cadence[cadence::period_s] * frames_per_s / 6);
}

/// Alternates fit and noise estimate until the noise converges.
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
  // Several initial guesses: the right period explains more than a third of it or three of it.
  for (const StridePeriod& guess : guess_periods(observations, 3)) {
    StrideFit fit = start(problem, guess);
    settle(problem, fit, Loss::cauchy, 2, kCoarse);
    if (fit.ok && (!best.ok || fit.sigma_px < 0.9 * best.sigma_px)) best = std::move(fit);
  }
  if (!best.ok) return best;

  settle(problem, best, Loss::tukey, 3, kCoarse);
  if (options.harmonics == 0) {
    // From many harmonics to few, at the noise of the largest model: each harmonic must lower the
    // criterion.
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
  // The stance feet determine the camera's roll, because they keep their height.
  for (int round = 0; round < 2; ++round) {
    best.vertical_oscillation = measure_vertical_oscillation(best, observations);
    const BodyPart part = best.toes_seen ? BodyPart::toe_r : BodyPart::ankle_r;
    problem.stance = {part, find_stance(best, problem.directions, part).phases};
    settle(problem, best, Loss::tukey, 4, round == 0 ? kCoarse : kFine);
  }
  best.vertical_oscillation = measure_vertical_oscillation(best, observations);
  estimate_covariance(problem, best);
  return best;
}

}  // namespace stride::fit
