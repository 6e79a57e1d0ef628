#include "calibrate/fit/solver/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "extract/io/statistics.h"
#include "extract/skeleton/robust_fit.h"

namespace stride::fit {

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
  const auto marks = static_cast<double>(absolute.size());
  const double freedom = std::max(0.2, 1 - parameters / marks);
  const double seen =
      std::max(kLeastSigma, kSigmaPerMedian * median(absolute) / std::sqrt(freedom));
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

}  // namespace stride::fit
