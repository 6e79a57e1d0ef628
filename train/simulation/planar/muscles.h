#pragma once

#include "train/simulation/planar/planar_model.h"

namespace stride::planar {

/// muscle_forces() of four muscles at once, optionally with derivatives.
struct MuscleGroup {
  simd::V4 tendon_force_n{};  // of the maximum force
  simd::V4 fiber_velocity_m_s{};
  // With slopes only.
  simd::V4 fiber_1_s{};           // ∂(fibre velocity)/∂(fibre length)
  simd::V4 stretch_1_s{};         // ∂(fibre velocity)/∂(path length)
  simd::V4 tendon_stiffness_n{};  // ∂(tendon force)/∂(path length), 1/m
  simd::V4 cos_inverse{};         // 1 / cos(pennation)
};

template <bool with_slopes>
[[gnu::always_inline]] inline MuscleGroup muscle_group(const PlanarModel::Muscles& m,
                                                       simd::V4 raw_activation,
                                                       simd::V4 fiber_length,
                                                       simd::V4 path_length) {
  using simd::V4;
  const V4 zero{};
  const V4 a = simd::min(simd::max(raw_activation, m.minimum_activation), simd::all(1));
  // The second bound keeps a muscle without pennation, whose minimum length is 0, from 0/0.
  const V4 length = simd::max(simd::max(fiber_length, m.minimum_length), simd::all(1e-12));
  const V4 along = simd::sqrt(length * length - m.width2);  // length · cos(pennation)
  const V4 cos_inverse = length / along;
  const V4 strain = (path_length - along) * m.slack_inverse - 1;
  const V4 excess = length * m.optimal_inverse - 1;

  const V4 fal = simd::exp(-excess * excess * m.active_shape_inverse);
  V4 fpe{}, fpe_slope{};
  if (simd::any(excess > zero)) {
    const V4 e = simd::exp(m.passive_rate * excess);
    fpe = excess > zero ? (e - 1) * m.passive_scale : zero;
    fpe_slope = excess > zero ? m.passive_rate * e * m.passive_scale : zero;
  }
  V4 fse{}, fse_slope{};
  if (simd::any(strain > zero)) {
    const V4 toe = simd::min(simd::max(strain, zero), m.toe_strain);
    const V4 e = simd::exp(m.toe_rate * toe);
    const auto beyond = strain > m.toe_strain;
    fse = m.toe_scale * (e - 1) + (beyond ? m.linear_stiffness * (strain - toe) : zero);
    fse_slope = beyond ? m.linear_stiffness : m.toe_scale * m.toe_rate * e;
    fse_slope = strain > zero ? fse_slope : zero;
  }

  const V4 force = fse * cos_inverse - fpe;
  const V4 isometric = a * fal;
  const V4 inside = simd::min(simd::max(force, zero), m.straight_from * isometric);
  const auto shortens = inside <= isometric;
  const V4 db = shortens ? m.af_inverse : m.lengthening;
  const V4 b =
      shortens ? isometric + inside * m.af_inverse : -m.lengthening * (isometric * m.flen - inside);
  const V4 b_inverse = 1 / b;
  const V4 share = (inside - isometric) * b_inverse;
  const V4 scale = (0.25 + 0.75 * a) * m.max_speed;
  const V4 slope = scale * b_inverse * (1 - share * db);
  const V4 speed = scale * share + slope * (force - inside);

  const auto still = (fiber_length <= m.minimum_length) & (speed <= zero);
  MuscleGroup result{fse, still ? zero : speed};
  if constexpr (with_slopes) {
    // The speed depends on force/isometric only, and the isometric force on the length through fal.
    const V4 inverse = 1 / length;
    const V4 tendon_stiffness = fse_slope * m.slack_inverse;
    const V4 force_slope =
        -cos_inverse * cos_inverse *
            (tendon_stiffness + fse * m.width2 * inverse * inverse * inverse * cos_inverse) -
        fpe_slope * m.optimal_inverse;
    const V4 fal_slope = -2 * excess * m.active_shape_inverse * m.optimal_inverse;  // relative
    result.fiber_1_s = still ? zero : slope * (force_slope - force * fal_slope);
    result.stretch_1_s = still ? zero : slope * tendon_stiffness * cos_inverse;
    result.tendon_stiffness_n = tendon_stiffness;
    result.cos_inverse = cos_inverse;
  }
  return result;
}

/// activation_rate() of four muscles at once.
inline simd::V4 activation_rate_group(const PlanarModel::Muscles& m, simd::V4 raw_activation,
                                      simd::V4 excitation) {
  using simd::V4;
  const V4 a = simd::min(simd::max(raw_activation, m.minimum_activation), simd::all(1));
  const V4 factor = 0.5 + 1.5 * a, gap = excitation - a;
  return gap > V4{} ? gap * m.tau_activation_inverse / factor
                    : gap * factor * m.tau_deactivation_inverse;
}

}  // namespace stride::planar
