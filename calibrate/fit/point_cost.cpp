#include "calibrate/fit/point_cost.h"

#include <ceres/jet.h>

#include <cmath>

namespace stride::fit {
namespace {

constexpr int kInner = 24;
using Jet = ceres::Jet<double, kInner>;
enum Inner {
  kCamera = 0,
  kBody = 3,
  kSides = 10,
  kTilt = 17,
  kLeg = 18,
  kPhase = 21,
  kPelvis = 22
};

/// cos and sin of every harmonic at a phase: derivatives of a series by its coefficients.
struct Basis {
  std::array<double, 2 * kMaxHarmonics + 1> value{}, slope{};  // and by phase

  Basis(double phase, int harmonics) {
    value[0] = 1;
    for (int h = 1; h <= harmonics; ++h) {
      const double turn = 2 * std::numbers::pi * h;
      value[2 * h - 1] = std::cos(turn * phase);
      value[2 * h] = std::sin(turn * phase);
      slope[2 * h - 1] = -turn * value[2 * h];
      slope[2 * h] = turn * value[2 * h - 1];
    }
  }
  double series(const double* c, int harmonics) const { return sum(value, c, harmonics); }
  double series_slope(const double* c, int harmonics) const { return sum(slope, c, harmonics); }

 private:
  static double sum(const std::array<double, 2 * kMaxHarmonics + 1>& by, const double* c, int n) {
    double total = 0;
    for (int k = 0; k <= 2 * n; ++k) total += by[k] * c[k];
    return total;
  }
};

/// n Jets that stand for the variables from `first` on.
template <int n>
std::array<Jet, n> variables(const double* values, int first) {
  std::array<Jet, n> jets;
  for (int i = 0; i < n; ++i) jets[i] = Jet(values[i], first + i);
  return jets;
}

}  // namespace

bool PointCost::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  const auto [camera, cadence, body, sides, tilt, hip, knee, ankle, asymmetry, pelvis] =
      std::array<const double*, 10>{parameters[0], parameters[1], parameters[2], parameters[3],
                                    parameters[4], parameters[5], parameters[6], parameters[7],
                                    parameters[8], parameters[9]};
  if (jacobians == nullptr)
    return residual_(camera, cadence, body, sides, tilt, hip, knee, ankle, asymmetry, pelvis,
                     residuals);

  const int harmonics = residual_.harmonics, side = side_of(residual_.part) < 0 ? -1 : 1;
  const double phase = phase_at(cadence, residual_.u_s), half = 0.5 * side;
  const Basis trunk(phase, 2), own(side > 0 ? phase : phase + 0.5, harmonics);
  const std::array<const double*, 3> curves{hip, knee, ankle};
  std::array<double, 3> angles, slopes;
  for (int j = 0; j < 3; ++j) {
    angles[j] = own.series(curves[j], harmonics) + half * own.series(asymmetry + 3 * j, 1);
    slopes[j] =
        own.series_slope(curves[j], harmonics) + half * own.series_slope(asymmetry + 3 * j, 1);
  }
  const auto leg = variables<3>(angles.data(), kLeg);
  std::array<Jet, 2> r;
  residual_.at_pose(variables<3>(camera, kCamera).data(), variables<7>(body, kBody).data(),
                    variables<7>(sides, kSides).data(), Jet(trunk.series(tilt, 2), kTilt),
                    LegAngles<Jet>{leg[0], leg[1], leg[2]}, Jet(phase, kPhase),
                    variables<2>(pelvis, kPelvis).data(), r.data());

  for (int row = 0; row < 2; ++row) {
    residuals[row] = r[row].a;
    const auto& d = r[row].v;
    const auto fill = [&](int block, int size, auto derivative) {
      if (jacobians[block] == nullptr) return;
      for (int k = 0; k < size; ++k) jacobians[block][row * size + k] = derivative(k);
    };
    double by_phase = d[kPhase] + d[kTilt] * trunk.series_slope(tilt, 2);
    for (int j = 0; j < 3; ++j) by_phase += d[kLeg + j] * slopes[j];
    const double u = residual_.u_s, period = cadence[cadence::period_s];
    fill(0, 3, [&](int k) { return d[kCamera + k]; });
    fill(1, 2, [&](int k) {
      return by_phase * (k == cadence::period_s ? -u / (period * period) : 0.5 * u * u);
    });
    fill(2, 7, [&](int k) { return d[kBody + k]; });
    fill(3, 7, [&](int k) { return d[kSides + k]; });
    fill(4, 5, [&](int k) { return d[kTilt] * trunk.value[k]; });
    for (int j = 0; j < 3; ++j) fill(5 + j, 13, [&](int k) { return d[kLeg + j] * own.value[k]; });
    fill(8, 9, [&](int k) { return d[kLeg + k / 3] * half * own.value[k % 3]; });
    fill(9, 2, [&](int k) { return d[kPelvis + k]; });
  }
  return true;
}

}  // namespace stride::fit
