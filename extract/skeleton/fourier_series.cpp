#include "extract/skeleton/fourier_series.h"

namespace stride {
namespace {

/// Cosine and sine of each harmonic's angle. How the angle is rounded is the caller's choice.
template <typename AngleOf>
void fill(std::span<double> waves, AngleOf angle_of) {
  double harmonic = 1;
  for (std::size_t i = 0; i + 1 < waves.size(); i += 2, ++harmonic) {
    const double angle = angle_of(harmonic);
    waves[i] = std::cos(angle);
    waves[i + 1] = std::sin(angle);
  }
}

}  // namespace

void fourier_basis(double phase, std::span<double> basis) {
  basis[0] = 1;
  fill(basis.subspan(1), [&](double h) { return 2 * std::numbers::pi * h * phase; });
}

Eigen::VectorXd fourier_basis(double phase, int harmonics) {
  Eigen::VectorXd basis(2 * harmonics + 1);
  fourier_basis(phase, std::span(basis.data(), static_cast<std::size_t>(basis.size())));
  return basis;
}

void fourier_waves(double angle_rad, std::span<double> waves) {
  fill(waves, [&](double h) { return h * angle_rad; });
}

}  // namespace stride
