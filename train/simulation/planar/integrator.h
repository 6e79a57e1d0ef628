#pragma once

#include <array>

#include "train/simulation/engine/engine.h"
#include "train/simulation/planar/activation.h"
#include "train/simulation/planar/dynamics.h"
#include "train/simulation/planar/linear.h"

namespace stride::planar {

/// Advances a PlanarDynamics with steps whose estimated error is kept below the accuracy: that of
/// speeds against 2 rad/s or m/s, of coordinates against 0.03 rad or m, of fibres against 3 mm. See
/// README.md for what makes the equations stiff and what is done about each.
///
/// Down to an accuracy of 3e-4 the steps are those of rosenbrock.h, implicit in what is stiff;
/// for tighter ones, where small steps are wanted anyway, Merson's explicit ones of higher order.
class PlanarIntegrator {
 public:
  using State = PlanarDynamics::State;
  using Fibers = PlanarDynamics::Fibers;

  explicit PlanarIntegrator(const simulation::EngineOptions& options);

  /// Forgets the step size that the past suggested.
  void restart() { step_s_ = 0, since_switch_s_ = 1; }

  /// On failure `y` and `activation` are left as they were.
  simulation::AdvanceReport advance(PlanarDynamics& dynamics, State& y, Fibers& activation,
                                    const Fibers& excitation, double duration_s);

 private:
  void advance_track(PlanarDynamics& dynamics, State& y, double duration_s,
                     simulation::AdvanceReport& report);
  double next_step(double left_s) const;
  void adapt(double h, double wanted, double error);
  void rosenbrock_step(PlanarDynamics& dynamics, const State& y, double time_s, double h);
  template <int i>
  void rosenbrock_stage(PlanarDynamics& dynamics, const State& y, double time_s, double h);
  void merson_step(PlanarDynamics& dynamics, const State& y, double time_s, double h);
  void evaluate(PlanarDynamics& dynamics, const State& y, double time_s, State& rate,
                PlanarLinear* linear = nullptr);
  double error() const;
  double crossing(const PlanarDynamics& dynamics, const State& y, double h) const;

  simulation::EngineOptions options_;
  bool implicit_;
  /// A path point that has switched stays for this long, lest the runner hover at its switch.
  double hold_s_;
  double since_switch_s_ = 1;
  double step_s_ = 0;
  bool rejected_ = false;  // the last attempt was: do not grow at once
  ActivationTrack track_;
  PlanarLinear linear_;
  PlanarSolver solver_;
  State first_;  // the rate at the beginning of the step
  State rate_;   // of a stage
  State next_, error_;
  std::array<State, 4> stage_;
};

}  // namespace stride::planar
