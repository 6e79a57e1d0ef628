#pragma once

#include <cmath>
#include <numbers>
#include <random>

namespace stride {

/// Engines give the same numbers everywhere; distributions of the standard library do not, so those
/// that are needed are here.
using Random = std::mt19937_64;

/// Uniform in [0, 1).
inline double uniform(Random& random) { return static_cast<double>(random() >> 11) * 0x1.0p-53; }

/// Standard normal (Box and Muller; the second value is not kept, so there is no hidden state).
inline double normal(Random& random) {
  const double radius = std::sqrt(-2 * std::log(1 - uniform(random)));
  return radius * std::cos(2 * std::numbers::pi * uniform(random));
}

}  // namespace stride
