#pragma once

// C++17-clean and free of Simbody and Eigen.

#include <algorithm>

#include "calibrate/osim/model.h"

namespace stride::laws {

/// OpenSim's CoordinateLimitForce in SI units: beyond a limit a spring and a damper, faded in over
/// the transition by the quintic step x³(10 - 15x + 6x²).
struct LimitLaw {
  double upper = 0, lower = 0, transition = 0;      // rad or m
  double upper_stiffness = 0, lower_stiffness = 0;  // N·m/rad or N/m
  double damping = 0;                               // N·m·s/rad or N·s/m
};

inline LimitLaw limit_law(const osim::CoordinateLimit& limit, bool rotational) {
  const double unit = rotational ? 0.017453292519943295 : 1;  // of the file, in rad or m
  return {limit.upper_limit * unit,     limit.lower_limit * unit,     limit.transition * unit,
          limit.upper_stiffness / unit, limit.lower_stiffness / unit, limit.damping / unit};
}

/// The generalised force on the coordinate.
inline double limit_force(const LimitLaw& law, double q, double u) {
  const auto step = [&](double excess) {
    const double x = std::clamp(excess / law.transition, 0.0, 1.0);
    return x * x * x * (10 + x * (6 * x - 15));
  };
  const double up = step(q - law.upper), low = step(law.lower - q);
  return -law.upper_stiffness * up * (q - law.upper) + law.lower_stiffness * low * (law.lower - q) -
         law.damping * (up + low) * u;
}

/// Stiffness and damping of the limit at rest: how the force decreases with the coordinate and with
/// its speed.
struct LimitSlopes {
  double stiffness = 0, damping = 0;
};

inline LimitSlopes limit_slopes(const LimitLaw& law, double q) {
  const bool above = q > law.upper;
  const double excess = above ? q - law.upper : law.lower - q;
  if (excess <= 0) return {};
  const double x = std::min(excess / law.transition, 1.0);
  const double step = x * x * x * (10 + x * (6 * x - 15));
  const double rise = 30 * x * x * (1 - x) * (1 - x) / law.transition;
  return {(above ? law.upper_stiffness : law.lower_stiffness) * (step + rise * excess),
          law.damping * step};
}

}  // namespace stride::laws
