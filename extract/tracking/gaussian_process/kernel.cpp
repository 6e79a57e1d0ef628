#include "extract/tracking/gaussian_process/kernel.h"

#include <cmath>
#include <numbers>

namespace stride::gaussian_process {

using Eigen::ArrayXd;

namespace {

double square(double x) { return x * x; }

ArrayXd matern52(const ArrayXd& lag, double length) {
  const ArrayXd a = std::sqrt(5.0) / length * lag.abs();
  return (1 + a + a.square() / 3) * (-a).exp();
}

/// Covariance of integrated Brownian motion from time 0 in both directions. Its posterior mean is
/// the cubic smoothing spline.
ArrayXd integrated_walk(const ArrayXd& t, double u) {
  const ArrayXd a = t.abs().min(std::abs(u)), b = t.abs().max(std::abs(u));
  return (t * u > 0).select(a.square() * (b / 2 - a / 6), 0.0);
}

/// Of a movement that does not repeat.
Eigen::MatrixXd of_passage(const Covariance& c, const Instants& a, const Instants& b) {
  const GaitKernel& k = c.k;
  const ArrayXd at = a.time_s / k.period_s;
  Eigen::MatrixXd result(a.time_s.size(), b.time_s.size());
  for (Eigen::Index j = 0; j < result.cols(); ++j) {
    const double u = b.time_s[j] / k.period_s;
    if (!c.paired) {
      result.col(j) = c.drift * (square(k.residual) * integrated_walk(at, u) + 10 * (1 + at * u));
      continue;
    }
    const ArrayXd other_leg = (a.left - b.left[j]).abs(),
                  moved = matern52(at - u, k.residual_strides);
    result.col(j) =
        4 + square(k.residual) * moved + (1 - other_leg) * (0.5 + square(k.asymmetry) * moved);
  }
  return result;
}

double of_passage_at(const Covariance& c, double time_s) {
  const GaitKernel& k = c.k;
  if (c.paired) return 4.5 + square(k.asymmetry) + square(k.residual);
  const double t = time_s / k.period_s;
  return c.drift * (square(k.residual) * std::pow(std::abs(t), 3) / 3 + 10 * (1 + t * t));
}

}  // namespace

Eigen::MatrixXd Covariance::operator()(const Instants& a, const Instants& b) const {
  if (!k.periodic) return of_passage(*this, a, b);
  // Periodic kernel: exp(−2 sin²(x/2) / ℓ²) = exp((cos x − 1) / ℓ²), x the difference of phases.
  // Its cosine follows from cosines and sines of the phases.
  const double per_s = 2 * std::numbers::pi / k.period_s, sharpness = 1 / square(k.length_scale);
  const ArrayXd strides = a.time_s / k.period_s, cos = (per_s * a.time_s).cos(),
                sin = (per_s * a.time_s).sin();
  Eigen::MatrixXd result(a.time_s.size(), b.time_s.size());
  for (Eigen::Index j = 0; j < result.cols(); ++j) {
    const double u = b.time_s[j] / k.period_s, angle = per_s * b.time_s[j];
    const ArrayXd lag = strides - u, cos_lag = std::cos(angle) * cos + std::sin(angle) * sin,
                  forgotten = lag.square() / (2 * square(k.coherence_strides));
    if (!paired) {
      const ArrayXd cos_step_lag = 2 * cos_lag.square() - 1;
      result.col(j) =
          square(k.amplitude) *
              (((cos_step_lag - 1) * sharpness - forgotten).exp() +
               square(k.asymmetry) * ((cos_lag - 1) * sharpness - forgotten).exp()) +
          drift * (square(k.residual) * integrated_walk(strides, u) + 10 * (1 + strides * u));
      continue;
    }
    // The left leg is half a stride later, where the cosine changes its sign.
    const ArrayXd other_leg = (a.left - b.left[j]).abs();
    const ArrayXd repeated = (((1 - 2 * other_leg) * cos_lag - 1) * sharpness - forgotten).exp();
    result.col(j) = 4 + repeated +
                    (1 - other_leg) * (0.5 + square(k.asymmetry) * repeated +
                                       square(k.residual) * matern52(lag, k.residual_strides));
  }
  return result;
}

double Covariance::at(double time_s) const {
  if (!k.periodic) return of_passage_at(*this, time_s);
  if (paired) return 5.5 + square(k.asymmetry) + square(k.residual);
  const double t = time_s / k.period_s;
  return square(k.amplitude) * (1 + square(k.asymmetry)) +
         drift * (square(k.residual) * std::pow(std::abs(t), 3) / 3 + 10 * (1 + t * t));
}

}  // namespace stride::gaussian_process
