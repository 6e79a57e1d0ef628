#pragma once

#include <array>

#include "train/simulation/engine/engine.h"
#include "train/simulation/planar/activation.h"
#include "train/simulation/planar/dynamics.h"
#include "train/simulation/planar/linear.h"

namespace stride::planar {

/// Advances a PlanarDynamics with steps whose estimated error is kept below the accuracy: that of
/// speeds against 2 rad/s or m/s (ankles: 10 rad/s), of coordinates against 0.03 rad or m, of
/// fibres against 3 mm. See README.md for what makes the equations stiff and what is done about
/// each.
///
/// The equations are stiff: a foot weighs 1.5 kg, friction below its transition speed is a damper,
/// and an ankle's speed limits the steps of an explicit method whatever the accuracy. Therefore
/// - the steps are those of a Rosenbrock–W method of third order (rosenbrock.h), implicit in
///   contact, friction, limits, obstacles, tendons and fibres (linear.h). Its order does not depend
///   on an exact Jacobian. For accuracies below 3e-4 steps are short anyway, and Merson's explicit
///   method of fourth order is used.
/// - activations depend on the excitation alone. They are integrated ahead for the whole duration
///   and interpolated by a cubic (activation.h).
/// - path points that appear and vanish change a muscle's length by up to 19 mm. They are frozen
///   during a step; a switch is located on the step's cubic, and the step ends there.
/// - the step size carries over from call to call, grows by at most half, not right after a
///   rejection, and the rest of the duration is divided evenly.
class PlanarIntegrator {
 public:
  using State = PlanarDynamics::State;
  using Fibers = PlanarDynamics::Fibers;

  explicit PlanarIntegrator(const simulation::EngineOptions& options);

  /// Forgets the step size of earlier calls.
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
  /// A path point that has switched stays for this long, so that a knee cannot chatter at it.
  double hold_s_;
  double since_switch_s_ = 1;
  double step_s_ = 0;
  bool rejected_ = false;  // the last attempt; the step must not grow right after it
  ActivationTrack track_;
  PlanarLinear linear_;
  PlanarSolver solver_;
  State first_;  // rate at the beginning of the step
  State rate_;   // rate of a stage
  State next_, error_;
  std::array<State, 4> stage_;
};

}  // namespace stride::planar
