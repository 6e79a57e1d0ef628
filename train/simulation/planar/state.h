#pragma once

#include <array>

#include "train/simulation/planar/model.h"

namespace stride::planar {

/// A number for each muscle, interleaved as in PlanarModel; the two lanes beyond the last muscle
/// repeat it.
using PlanarFibers = std::array<simd::V4, PlanarModel::kMuscleGroups>;

/// Poses, speeds and fibre lengths, or their rates, interleaved as in PlanarModel: three vectors of
/// coordinates, three of speeds, five of fibres. Lanes beyond the last coordinate are zero.
struct PlanarState {
  static constexpr int kU = 3, kFiber = 6, kSize = 11;
  std::array<simd::V4, kSize> y{};

  double q(int i) const { return y[i / 4][i % 4]; }
  double u(int i) const { return y[kU + i / 4][i % 4]; }
  void set_q(int i, double value) { y[i / 4][i % 4] = value; }
  void set_u(int i, double value) { y[kU + i / 4][i % 4] = value; }
  /// Of hip, knee or ankle.
  simd::V2 joint_q(int j) const { return simd::V2{q(2 * j), q(2 * j + 1)}; }
  simd::V2 joint_u(int j) const { return simd::V2{u(2 * j), u(2 * j + 1)}; }
};

}  // namespace stride::planar
