#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace stride {

/// The standard engines give the same numbers everywhere, the standard distributions do not; hence
/// these.
using Random = std::mt19937_64;

/// Uniform in [0, 1).
inline double uniform(Random& random) { return static_cast<double>(random() >> 11) * 0x1.0p-53; }

/// Of two independent standard normal numbers the distance from 0 (Box and Muller), from a uniform
/// number in (0, 1].
inline double normal_radius(double uniform) { return std::sqrt(-2 * std::log(uniform)); }

/// Standard normal (the second value is not kept, so there is no hidden state).
inline double normal(Random& random) {
  const double radius = normal_radius(1 - uniform(random));
  return radius * std::cos(2 * std::numbers::pi * uniform(random));
}

/// Both values, of uniform numbers in (0, 1): another stream than normal()'s.
inline std::array<double, 2> normal_pair(Random& random) {
  const auto inside = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  const double radius = normal_radius(inside());
  const double angle = 2 * std::numbers::pi * inside();
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// An independent seed for stream `stream` of a run: a finaliser of splitmix64 over both.
inline std::uint64_t stream_seed(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t z = seed + 0x9e3779b97f4a7c15ULL * (stream + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// Uniform in 0 … n − 1, without bias.
inline std::uint64_t uniform_index(Random& random, std::uint64_t n) {
  const std::uint64_t limit = Random::max() - Random::max() % n;
  std::uint64_t draw = random();
  while (draw >= limit) draw = random();
  return draw % n;
}

}  // namespace stride
