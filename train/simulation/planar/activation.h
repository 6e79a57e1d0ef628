#pragma once

#include <array>

#include "train/simulation/planar/dynamics.h"

namespace stride::planar {

/// The activations during a time of constant excitation. They depend on nothing else, so they are
/// integrated ahead by the Runge–Kutta method from node to node, with Hermite cubics between; the
/// integrator of the skeleton need not resolve them.
class ActivationTrack {
 public:
  using Fibers = PlanarDynamics::Fibers;
  static constexpr int kMostNodes = 128;

  void build(const PlanarDynamics& dynamics, const Fibers& start, const Fibers& excitation,
             double duration_s, int intervals);
  void at(double time_s, Fibers& activation) const;
  const Fibers& end() const { return value_[intervals_]; }

 private:
  int intervals_ = 0;
  double spacing_s_ = 0;
  std::array<Fibers, kMostNodes + 1> value_, rate_;
};

}  // namespace stride::planar
