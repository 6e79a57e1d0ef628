#include "calibrate/fit/vertical_oscillation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "extract/skeleton/fourier_series.h"
#include "extract/skeleton/robust_fit.h"

namespace stride::fit {

Eigen::Vector4d VerticalOscillation::weights(double phase) {
  Eigen::Vector4d waves;
  fourier_waves(4 * std::numbers::pi * phase, {waves.data(), 4});
  return waves;
}

double VerticalOscillation::peak_to_peak_m() const {
  double low = 0, high = 0;
  for (int i = 0; i < 100; ++i) {
    const double h = (*this)(i / 100.0);
    low = std::min(low, h);
    high = std::max(high, h);
  }
  return high - low;
}

VerticalOscillation measure_vertical_oscillation(const StrideFit& fit, const Marks& observations) {
  const Runner& runner = fit.runner;
  const auto n = static_cast<Eigen::Index>(observations.u_s.size());
  const double strides = observations.duration_s / runner.cadence[cadence::period_s];
  // Slow motion: a straight line, and sines of at most 0.9 of the stride frequency.
  const int waves = static_cast<int>(1.8 * strides);
  Eigen::MatrixXd rows(n, 4 + 2 + waves);
  Eigen::VectorXd height(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double u = observations.u_s[static_cast<std::size_t>(i)];
    const double scale =
        std::exp(runner.camera[camera::log_px_per_m] + runner.camera[camera::drift_per_s] * u);
    height[i] = turned(-runner.camera[camera::roll], fit.pelvis_px[i]).y() / scale;
    rows.row(i).head<4>() =
        VerticalOscillation::weights(phase_at(runner.cadence.data(), u)).transpose();
    rows(i, 4) = 1;
    const double part = u / std::max(observations.duration_s, 1e-9);  // −½ … ½
    rows(i, 5) = part;
    for (int k = 1; k <= waves; ++k) rows(i, 5 + k) = std::cos(std::numbers::pi * k * (part + 0.5));
  }
  VerticalOscillation vertical_oscillation;
  if (n < rows.cols() + 4) return vertical_oscillation;
  Eigen::LDLT<Eigen::MatrixXd> solver;
  const auto weighted_fit = [&](const Eigen::VectorXd& weights) -> Eigen::VectorXd {
    const Eigen::MatrixXd weighted = weights.asDiagonal() * rows;
    Eigen::MatrixXd normal = rows.transpose() * weighted;
    normal.diagonal().array() += 1e-10 * static_cast<double>(n);
    solver.compute(normal);
    const Eigen::VectorXd solution = solver.solve(weighted.transpose() * height);
    vertical_oscillation.c = solution.head<4>();
    return (height - rows * solution).cwiseAbs();
  };
  const RobustOptions options{
      .rounds = 8, .spread_per_median = kSigmaPerMedian, .least_spread = 1e-9, .width = 2.5};
  const double sd = robust_fit(Eigen::VectorXd::Ones(n), options, weighted_fit).spread;
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(rows.cols(), 4);
  vertical_oscillation.covariance = sd * sd * fit.correlation * solver.solve(unit).topRows<4>();
  return vertical_oscillation;
}

}  // namespace stride::fit
