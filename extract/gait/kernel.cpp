#include "extract/gait/kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stride {
namespace {

double periodic(double lag_s, double period_s, double roughness) {
  const double s = std::sin(std::numbers::pi * lag_s / period_s);
  return std::exp(-2 * s * s / (roughness * roughness));
}

double matern52(double lag, double length) {
  const double a = std::sqrt(5.0) * std::abs(lag) / length;
  return (1 + a + a * a / 3) * std::exp(-a);
}

/// Covariance of the integral of Brownian motion started at time 0 in either direction: its
/// regression curve is the cubic smoothing spline.
double integrated_walk(double t, double u) {
  if (t * u <= 0) return 0;
  const double a = std::min(std::abs(t), std::abs(u)), b = std::max(std::abs(t), std::abs(u));
  return a * a * (b / 2 - a / 6);
}

}  // namespace

double Covariance::operator()(double t, int t_left, double u, int u_left) const {
  const double lag = t - u, strides = lag / k.period_s;
  const double coherence =
      std::exp(-strides * strides / (2 * k.coherence_strides * k.coherence_strides));
  const double asymmetric =
      k.asymmetry * k.asymmetry * coherence * periodic(lag, k.period_s, k.roughness);
  if (!paired)
    return k.amplitude * k.amplitude *
               (coherence * periodic(lag, k.period_s / 2, k.roughness) + asymmetric) +
           drift * (k.residual * k.residual * integrated_walk(t / k.period_s, u / k.period_s) +
                    10 * (1 + t * u / (k.period_s * k.period_s)));
  double sum =
      4 + coherence * periodic(lag + 0.5 * k.period_s * (t_left - u_left), k.period_s, k.roughness);
  if (t_left == u_left)
    sum += 0.5 + asymmetric + k.residual * k.residual * matern52(strides, k.residual_strides);
  return sum;
}

}  // namespace stride
