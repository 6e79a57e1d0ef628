#include "calibrate/fit/solver/point_cost.h"

#include <ceres/jet.h>

#include <cmath>

namespace stride::fit {
namespace {

/// Where the numbers between begin that are differentiated automatically.
enum Inner {
  kCamera = 0,
  kBody = kCamera + camera::size,
  kSides = kBody + body::size,
  kTilt = kSides + sides::size,
  kLeg = kTilt + 1,
  kPhase = kLeg + 3,
  kPelvis = kPhase + 1,
  kHeel = kPelvis + 2
};
template <typename Residual>
inline constexpr bool kOfHeel = std::is_same_v<Residual, HeelResidual>;
template <typename Residual>
using JetOf = ceres::Jet<double, kHeel + (kOfHeel<Residual> ? heel::size : 0)>;

/// cos and sin of every harmonic at a phase: derivatives of a series by its coefficients.
struct Basis {
  FourierSeries<kMaxHarmonics> value{}, slope{};  // and by phase

  Basis(double phase, int harmonics) {
    fourier_basis(phase, std::span(value).first(2 * harmonics + 1));
    for (int h = 1; h <= harmonics; ++h) {
      const double turn = 2 * std::numbers::pi * h;
      slope[2 * h - 1] = -turn * value[2 * h];
      slope[2 * h] = turn * value[2 * h - 1];
    }
  }
  double series(const double* c, int harmonics) const { return sum(value, c, harmonics); }
  double series_slope(const double* c, int harmonics) const { return sum(slope, c, harmonics); }

 private:
  static double sum(const FourierSeries<kMaxHarmonics>& by, const double* c, int n) {
    double total = 0;
    for (int k = 0; k <= 2 * n; ++k) total += by[k] * c[k];
    return total;
  }
};

/// n Jets that stand for the variables from `first` on.
template <typename Jet, int n>
std::array<Jet, n> variables(const double* values, int first) {
  std::array<Jet, n> jets;
  for (int i = 0; i < n; ++i) jets[i] = Jet(values[i], first + i);
  return jets;
}

}  // namespace

template <typename Residual>
bool CostByChainRule<Residual>::Evaluate(double const* const* parameters, double* residuals,
                                         double** jacobians) const {
  using Jet = JetOf<Residual>;
  const auto [camera, cadence, body, sides, tilt, hip, knee, ankle, asymmetry, pelvis] =
      std::array<const double*, 10>{parameters[0], parameters[1], parameters[2], parameters[3],
                                    parameters[4], parameters[5], parameters[6], parameters[7],
                                    parameters[8], parameters[9]};
  const double* heel = kOfHeel<Residual> ? parameters[10] : nullptr;
  if (jacobians == nullptr) {
    if constexpr (kOfHeel<Residual>)
      return residual_(camera, cadence, body, sides, tilt, hip, knee, ankle, asymmetry, pelvis,
                       heel, residuals);
    else
      return residual_(camera, cadence, body, sides, tilt, hip, knee, ankle, asymmetry, pelvis,
                       residuals);
  }

  constexpr std::array asymmetry_at{asymmetry::hip, asymmetry::knee, asymmetry::ankle};
  const int harmonics = residual_.harmonics, side = side_of(residual_.part) < 0 ? -1 : 1;
  const double phase = phase_at(cadence, residual_.u_s), half = 0.5 * side;
  const Basis trunk(phase, kTiltHarmonics), own(side > 0 ? phase : phase + 0.5, harmonics);
  const std::array<const double*, 3> curves{hip, knee, ankle};
  std::array<double, 3> angles, slopes;
  for (int j = 0; j < 3; ++j) {
    const double* difference = asymmetry + asymmetry_at[j];
    angles[j] =
        own.series(curves[j], harmonics) + half * own.series(difference, kAsymmetryHarmonics);
    slopes[j] = own.series_slope(curves[j], harmonics) +
                half * own.series_slope(difference, kAsymmetryHarmonics);
  }
  const auto leg = variables<Jet, 3>(angles.data(), kLeg);
  std::array<Jet, 2> r;
  const auto evaluate = [this, &camera = camera, &body = body, &sides = sides, &trunk, &tilt = tilt,
                         &leg, &phase, &pelvis = pelvis, &r](auto... on_foot) {
    residual_.at_pose(variables<Jet, camera::size>(camera, kCamera).data(),
                      variables<Jet, body::size>(body, kBody).data(),
                      variables<Jet, sides::size>(sides, kSides).data(),
                      Jet(trunk.series(tilt, kTiltHarmonics), kTilt),
                      LegAngles<Jet>{leg[0], leg[1], leg[2]}, Jet(phase, kPhase),
                      variables<Jet, 2>(pelvis, kPelvis).data(), on_foot..., r.data());
  };
  if constexpr (kOfHeel<Residual>)
    evaluate(variables<Jet, heel::size>(heel, kHeel).data());
  else
    evaluate();

  for (int row = 0; row < 2; ++row) {
    residuals[row] = r[row].a;
    const auto& d = r[row].v;
    auto fill = [&, block = 0](auto derivative) mutable {  // in the order of the arguments
      const int size = this->parameter_block_sizes()[block];
      double* jacobian = jacobians[block++];
      if (jacobian == nullptr) return;
      for (int k = 0; k < size; ++k) jacobian[row * size + k] = derivative(k);
    };
    double by_phase = d[kPhase] + d[kTilt] * trunk.series_slope(tilt, kTiltHarmonics);
    for (int j = 0; j < 3; ++j) by_phase += d[kLeg + j] * slopes[j];
    const double u = residual_.u_s, period = cadence[cadence::period_s];
    fill([&](int k) { return d[kCamera + k]; });
    fill([&](int k) {
      return by_phase * (k == cadence::period_s ? -u / (period * period) : 0.5 * u * u);
    });
    fill([&](int k) { return d[kBody + k]; });
    fill([&](int k) { return d[kSides + k]; });
    fill([&](int k) { return d[kTilt] * trunk.value[k]; });
    for (int j = 0; j < 3; ++j) fill([&](int k) { return d[kLeg + j] * own.value[k]; });
    fill([&](int k) {
      return d[kLeg + k / asymmetry::knee] * half * own.value[k % asymmetry::knee];
    });
    fill([&](int k) { return d[kPelvis + k]; });
    if constexpr (kOfHeel<Residual>) fill([&](int k) { return d[kHeel + k]; });
  }
  return true;
}

template class CostByChainRule<PointResidual>;
template class CostByChainRule<HeelResidual>;

}  // namespace stride::fit
