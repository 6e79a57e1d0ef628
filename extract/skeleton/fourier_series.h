#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace stride {

/// The coefficients of a periodic curve of a phase φ, one period being 1:
///
///     c[0] + Σ_h c[2h−1] cos 2πhφ + c[2h] sin 2πhφ
template <int kHarmonics>
using FourierSeries = std::array<double, 2 * kHarmonics + 1>;

/// What the coefficients are multiplied with: 1, cos 2πφ, sin 2πφ, cos 4πφ, … An odd number.
void fourier_basis(double phase, std::span<double> basis);
Eigen::VectorXd fourier_basis(double phase, int harmonics);

/// Without the constant, of an angle: cos α, sin α, cos 2α, … An even number.
void fourier_waves(double angle_rad, std::span<double> waves);

/// The value at a phase of a series, of which `harmonics` harmonics count. For types of automatic
/// differentiation too.
template <typename T>
T evaluate_series(const T* c, int harmonics, const T& phase) {
  using std::cos;
  using std::sin;
  const T angle = 2 * std::numbers::pi * phase, c1 = cos(angle), s1 = sin(angle);
  T value = c[0], ch = c1, sh = s1;
  for (int h = 1; h <= harmonics; ++h) {
    value += c[2 * h - 1] * ch + c[2 * h] * sh;
    const T next = ch * c1 - sh * s1;  // cos (h + 1) α
    sh = sh * c1 + ch * s1;
    ch = next;
  }
  return value;
}

}  // namespace stride
