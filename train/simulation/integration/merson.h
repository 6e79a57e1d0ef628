#pragma once

// C++17-clean and free of Simbody and Eigen.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "train/simulation/engine/engine.h"

namespace stride::integration {

/// Merson's fourth-order Runge–Kutta method with its embedded error estimate, OpenSim's integrator.
/// `rate(y, ydot)` writes the derivative of y; `error_of(difference)` is the norm of an error
/// estimate, which is kept below the accuracy.
template <std::size_t N>
class MersonIntegrator {
 public:
  using Vector = std::array<double, N>;

  /// Forgets the step size of earlier calls.
  void restart() { step_s_ = 0; }

  /// Advances `y` by duration_s. On failure `y` is the last good state.
  template <typename Rate, typename Norm>
  simulation::AdvanceReport advance(Vector& y, double duration_s,
                                    const simulation::EngineOptions& options, const Rate& rate,
                                    const Norm& error_of) {
    simulation::AdvanceReport report;
    double left = duration_s;
    bool have_first = false;
    if (step_s_ <= 0) step_s_ = duration_s / 10;
    while (left > 0) {
      const double wanted = options.fixed_step ? options.fixed_step_s : step_s_;
      // The last steps divide the rest evenly, so that no tiny step remains.
      const bool last = wanted >= left * (1 - 1e-12);
      const double h = last ? left : wanted > left / 2 ? left / 2 : wanted;
      if (report.evaluations + 5 > options.max_evaluations)
        return fail(report, "the evaluations ran out");

      if (!have_first) rate(y, k1_), ++report.evaluations;
      attempt(y, h, rate);
      report.evaluations += 4;
      const double error = error_of(error_) / options.accuracy;
      const bool finite = std::isfinite(error) && is_finite(next_);
      // No error estimate is small across a discontinuous force, so steps this small are accepted.
      // Where the force chatters that would take forever: after a quarter of the allowed
      // evaluations longer steps are accepted too, and the state slides along the discontinuity.
      const double crossing_s = report.evaluations < options.max_evaluations / 4 ? 1e-12 : 1e-5;
      const bool crossing = h <= crossing_s;
      const bool accepted = finite && (error <= 1 || crossing || options.fixed_step);
      if (!finite && (crossing || options.fixed_step))
        return fail(report, "the state is not finite");
      if (accepted) {
        y = next_;
        left = last ? 0 : left - h;
      }
      have_first = !accepted;
      ++(accepted ? report.steps : report.rejected);
      const double factor = finite ? 0.9 * std::pow(std::max(error, 1e-10), -0.25) : 0.1;
      const double proposal = accepted && error > 1 ? crossing_s
                              : accepted            ? h * std::clamp(factor, 0.1, 5.0)
                                                    : h * std::clamp(factor, 0.1, 0.9);
      // A step cut short by the end of the interval does not reduce the step size.
      step_s_ = accepted && error <= 1 && h < wanted ? std::max(wanted, proposal) : proposal;
    }
    return report;
  }

 private:
  static simulation::AdvanceReport fail(simulation::AdvanceReport report, const char* why) {
    report.ok = false;
    report.failure = why;
    return report;
  }

  static bool is_finite(const Vector& y) {
    return std::all_of(y.begin(), y.end(), [](double each) { return std::isfinite(each); });
  }

  template <typename Rate>
  void attempt(const Vector& y, double h, const Rate& rate) {
    for (std::size_t i = 0; i < N; ++i) at_[i] = y[i] + h / 3 * k1_[i];
    rate(at_, k2_);
    for (std::size_t i = 0; i < N; ++i) at_[i] = y[i] + h / 6 * (k1_[i] + k2_[i]);
    rate(at_, k3_);
    for (std::size_t i = 0; i < N; ++i) at_[i] = y[i] + h / 8 * (k1_[i] + 3 * k3_[i]);
    rate(at_, k4_);
    for (std::size_t i = 0; i < N; ++i) at_[i] = y[i] + h / 2 * (k1_[i] - 3 * k3_[i] + 4 * k4_[i]);
    rate(at_, k5_);
    for (std::size_t i = 0; i < N; ++i) {
      next_[i] = y[i] + h / 6 * (k1_[i] + 4 * k4_[i] + k5_[i]);
      error_[i] = 0.2 * (next_[i] - at_[i]);
    }
  }

  double step_s_ = 0;
  Vector k1_{}, k2_{}, k3_{}, k4_{}, k5_{}, at_{}, next_{}, error_{};
};

}  // namespace stride::integration
