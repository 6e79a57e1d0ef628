#pragma once

#include "train/simulation/engine.h"
#include "train/simulation/planar_dynamics.h"

namespace stride {

class PlanarIntegrator {
 public:
  explicit PlanarIntegrator(const EngineOptions& options) : options_(options) {}
  void restart() { step_s_ = 0; }
  AdvanceReport advance(PlanarDynamics& dynamics, PlanarDynamics::State& y,
                        PlanarDynamics::Fibers& activation,
                        const PlanarDynamics::Fibers& excitation, double duration_s);

 private:
  EngineOptions options_;
  double step_s_ = 0;
};

}  // namespace stride
