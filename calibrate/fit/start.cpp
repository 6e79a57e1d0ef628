#include "calibrate/fit/start.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "calibrate/fit/solver/noise.h"
#include "extract/io/statistics.h"
#include "extract/skeleton/units.h"

namespace stride::fit {
namespace {

/// Sets the pelvis of every frame to the median over its points, so one outlier has no effect.
void place_pelvis(const FitProblem& problem, StrideFit& fit) {
  std::vector<std::vector<double>> x(fit.pelvis_px.size()), y(fit.pelvis_px.size());
  for (Eigen::Vector2d& pelvis : fit.pelvis_px) pelvis.setZero();
  for (const Mark& mark : problem.observations.points) {
    if (mark.part == BodyPart::head || is_heel(mark.part)) continue;
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
  fit.toes_seen = all.sees_toes();
  fit.heels_seen = all.sees_heels();
  fit.heel = usual_heel(problem);
  fit.head_seen = all.sees(BodyPart::head);
  fit.explained = guess.explained;
  fit.harmonics = problem.options.harmonics > 0 ? problem.options.harmonics : 3;
  fit.runner = guess_runner(all, problem.model, guess.period_s, problem.options.leg_m.mean);
  std::optional<double> metres_per_pixel = problem.options.metres_per_pixel;
  if (const auto& scale = problem.options.measured_scale)
    metres_per_pixel = scale->metres_per_pixel;
  if (metres_per_pixel) {
    const double px_per_m = 1 / *metres_per_pixel;
    const double ratio = std::exp(fit.runner.camera[camera::log_px_per_m]) / px_per_m;
    fit.runner.camera[camera::log_px_per_m] = std::log(px_per_m);
    for (const int i : {body::thigh, body::shank, body::foot, body::trunk})
      fit.runner.body[i] *= ratio;
  }
  fit.backward = fit.runner.knee[0] > 0;  // before the limits of the joints forbid it
  fit.runner.tilt[0] = -4 * kDegree;
  fit.runner.hip[0] += 4 * kDegree;
  fit.pelvis_px.assign(all.u_s.size(), Eigen::Vector2d::Zero());
  place_pelvis(problem, fit);
  estimate_noise(problem, fit);
  return fit;
}

}  // namespace stride::fit
