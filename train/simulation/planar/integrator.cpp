#include "train/simulation/planar/integrator.h"

#include <algorithm>
#include <cmath>

#include "train/simulation/integration/rosenbrock.h"

namespace stride::planar {

using State = PlanarDynamics::State;
using simd::V4;

namespace {

constexpr double kTrack_s = 0.01;         // longest time whose activations are integrated ahead
constexpr double kImplicitDownTo = 3e-4;  // accuracy
// Scales of the errors of speeds (rad/s, m/s), coordinates (rad, m) and fibres (m).
// An ankle turns a foot of 1.5 kg, whose speed matters little to the rest, and decays.
constexpr double kSpeed = 2, kAnkleSpeed = 10, kCoordinate = 0.03, kFiber_m = 0.003;
constexpr V4 kAnklesAndBase{kAnkleSpeed, kAnkleSpeed, kSpeed, kSpeed};  // lanes of State::kU + 1

void add(State& to, double factor, const State& what) {
  for (int i = 0; i < State::kSize; ++i) to.y[i] += factor * what.y[i];
}

/// to += Σ factor[j] / divisor · what[j] over the first n
template <int n>
void add(State& to, const integration::Rosenbrock::Row& factor, double divisor,
         const std::array<State, 4>& what) {
  double f[n];
  for (int j = 0; j < n; ++j) f[j] = factor[j] / divisor;
  for (int i = 0; i < State::kSize; ++i) {
    V4 sum = to.y[i];
    for (int j = 0; j < n; ++j) sum += f[j] * what[j].y[i];
    to.y[i] = sum;
  }
}

void fail(simulation::AdvanceReport& report, const char* why) {
  report.ok = false;
  report.failure = why;
}

}  // namespace

PlanarIntegrator::PlanarIntegrator(const simulation::EngineOptions& options)
    : options_(options),
      implicit_(options.fixed_step || options.accuracy >= kImplicitDownTo),
      hold_s_(std::clamp(0.1 * options.accuracy, 1e-6, 1e-4)) {}

simulation::AdvanceReport PlanarIntegrator::advance(PlanarDynamics& dynamics, State& y,
                                                    Fibers& activation, const Fibers& excitation,
                                                    double duration_s) {
  simulation::AdvanceReport report;
  // Enough nodes that the error of the activations, a method of fourth order, is negligible.
  const double accuracy = options_.fixed_step ? 1e-3 : options_.accuracy;
  const int nodes = static_cast<int>(std::ceil(8 * std::pow(accuracy / 1e-3, -0.25)));
  const int tracks = std::max(1, static_cast<int>(std::ceil(duration_s / kTrack_s - 1e-9)));
  const State y_before = y;
  const Fibers activation_before = activation;
  for (int i = 0; i < tracks && report.ok; ++i) {
    track_.build(dynamics, activation, excitation, duration_s / tracks, nodes);
    advance_track(dynamics, y, duration_s / tracks, report);
    activation = track_.end();
  }
  if (!report.ok) {
    y = y_before;
    activation = activation_before;
    restart();
  }
  return report;
}

void PlanarIntegrator::advance_track(PlanarDynamics& dynamics, State& y, double duration_s,
                                     simulation::AdvanceReport& report) {
  if (step_s_ <= 0) step_s_ = kTrack_s / 10;
  dynamics.set_modes(dynamics.modes_at(y));
  double left = duration_s;
  bool have_first = false;
  double cut = 0;  // length of a step that ends at the switch of a path point
  while (left > 0) {
    if (report.evaluations + 5 > options_.max_evaluations) {
      return fail(report, "the evaluations ran out");
    }
    const double wanted = options_.fixed_step ? options_.fixed_step_s : step_s_;
    const double h = cut > 0 ? std::min(cut, next_step(left)) : next_step(left);
    const double time = duration_s - left;
    if (!have_first) {
      evaluate(dynamics, y, time, first_, implicit_ ? &linear_ : nullptr);
      ++report.evaluations;
      have_first = true;
    }
    implicit_ ? rosenbrock_step(dynamics, y, time, h) : merson_step(dynamics, y, time, h);
    report.evaluations += implicit_ ? 3 : 4;

    const double relative = error() / options_.accuracy;
    const bool finite = std::isfinite(relative);
    // No error estimate is small across a discontinuous force, so steps this small are accepted.
    // Where the force chatters, longer steps are accepted after a while, and the state slides along
    // the discontinuity.
    const bool patient = report.evaluations < options_.max_evaluations / 4;
    const double crossing_s = patient ? 1e-10 : 1e-5;
    const bool crosses = h <= crossing_s;
    if (!finite && (crosses || options_.fixed_step)) return fail(report, "the state is not finite");
    if (!finite || (relative > 1 && !crosses && !options_.fixed_step)) {
      ++report.rejected;
      cut = 0;
      adapt(h, wanted, relative);
      continue;
    }
    const PlanarDynamics::Modes modes = dynamics.modes_at(next_);
    const bool switches = modes != dynamics.modes();
    if (switches && cut == 0 && !options_.fixed_step && h > hold_s_ / 10) {
      cut = std::max({crossing(dynamics, y, h), hold_s_ - since_switch_s_, hold_s_ / 10});
      ++report.rejected;
      continue;
    }
    y = next_;
    left = h >= left ? 0 : left - h;
    have_first = false;
    cut = 0;
    ++report.steps;
    since_switch_s_ = switches ? 0 : since_switch_s_ + h;
    if (switches) dynamics.set_modes(modes);
    if (relative > 1) {
      step_s_ = std::max(h, crossing_s);
    } else {
      adapt(h, wanted, relative);
    }
  }
}

/// The remaining steps divide the rest of the duration evenly.
double PlanarIntegrator::next_step(double left_s) const {
  const double wanted = options_.fixed_step ? options_.fixed_step_s : step_s_;
  if (wanted >= left_s * (1 - 1e-9)) return left_s;
  return options_.fixed_step ? wanted : left_s / std::ceil(left_s / wanted - 1e-9);
}

void PlanarIntegrator::adapt(double h, double wanted, double error) {
  const bool good = error <= 1;
  const double order = implicit_ ? 3 : 4;
  const double factor =
      std::isfinite(error) ? 0.85 * std::pow(std::max(error, 1e-6), -1 / order) : 0.1;
  const double proposal = h * std::clamp(factor, 0.1, good ? (rejected_ ? 1 : 1.5) : 0.9);
  // A step that was cut short reduces the step size only if its error does.
  step_s_ = good && h < wanted ? std::max(std::min(wanted, h * factor), proposal) : proposal;
  rejected_ = !good;
}

void PlanarIntegrator::evaluate(PlanarDynamics& dynamics, const State& y, double time_s,
                                State& rate, PlanarLinear* linear) {
  Fibers activation;
  track_.at(time_s, activation);
  dynamics.evaluate(y, activation, rate, linear);
}

void PlanarIntegrator::rosenbrock_step(PlanarDynamics& dynamics, const State& y, double time_s,
                                       double h) {
  solver_.factor(linear_, h * integration::Rosenbrock::kGamma);
  solver_.solve(linear_, first_, stage_[0]);
  rosenbrock_stage<1>(dynamics, y, time_s, h);
  rosenbrock_stage<2>(dynamics, y, time_s, h);
  rosenbrock_stage<3>(dynamics, y, time_s, h);
  next_ = y;
  add<4>(next_, integration::kRosenbrock.weight, 1, stage_);
  error_ = {};
  add<4>(error_, integration::kRosenbrock.error, 1, stage_);
}

template <int i>
void PlanarIntegrator::rosenbrock_stage(PlanarDynamics& dynamics, const State& y, double time_s,
                                        double h) {
  State at = y;
  add<i>(at, integration::kRosenbrock.at[i], 1, stage_);
  evaluate(dynamics, at, time_s + integration::kRosenbrock.time[i] * h, rate_);
  add<i>(rate_, integration::kRosenbrock.carry[i], h, stage_);
  solver_.solve(linear_, rate_, stage_[i]);
}

void PlanarIntegrator::merson_step(PlanarDynamics& dynamics, const State& y, double time_s,
                                   double h) {
  State at = y;
  add(at, h / 3, first_);
  evaluate(dynamics, at, time_s + h / 3, stage_[0]);
  at = y;
  add(at, h / 6, first_), add(at, h / 6, stage_[0]);
  evaluate(dynamics, at, time_s + h / 3, stage_[1]);
  at = y;
  add(at, h / 8, first_), add(at, 3 * h / 8, stage_[1]);
  evaluate(dynamics, at, time_s + h / 2, stage_[2]);
  at = y;
  add(at, h / 2, first_), add(at, -3 * h / 2, stage_[1]), add(at, 2 * h, stage_[2]);
  evaluate(dynamics, at, time_s + h, stage_[3]);
  next_ = y;
  add(next_, h / 6, first_), add(next_, 2 * h / 3, stage_[2]), add(next_, h / 6, stage_[3]);
  error_ = {};
  add(error_, 0.2, next_), add(error_, -0.2, at);
}

double PlanarIntegrator::error() const {
  V4 worst{}, sum{};  // the sum is not finite if any error is not
  for (int i = 0; i < State::kSize; ++i) {
    const double unit = i >= State::kFiber ? kFiber_m : i >= State::kU ? kSpeed : kCoordinate;
    const V4 e = error_.y[i] / (i == State::kU + 1 ? kAnklesAndBase : simd::all(unit));
    worst = simd::max(worst, simd::max(e, -e));
    sum += e;
  }
  for (int i = 0; i < 4; ++i) {
    if (!std::isfinite(sum[i])) return sum[i];
  }
  return std::max(std::max(worst[0], worst[1]), std::max(worst[2], worst[3]));
}

/// Time from y at which a path point switches before next_: by bisection on Hermite's cubic through
/// both ends.
double PlanarIntegrator::crossing(const PlanarDynamics& dynamics, const State& y, double h) const {
  double low = 0, high = 1;
  while ((high - low) * h > hold_s_ / 1000) {
    const double x = 0.5 * (low + high), rest = 1 - x;
    State at;
    for (int i = 0; i < State::kU; ++i) {
      at.y[i] = (1 + 2 * x) * rest * rest * y.y[i] + x * x * (3 - 2 * x) * next_.y[i] +
                h * x * rest * (rest * y.y[State::kU + i] - x * next_.y[State::kU + i]);
    }
    (dynamics.modes_at(at) == dynamics.modes() ? low : high) = x;
  }
  return high * h;
}

}  // namespace stride::planar
