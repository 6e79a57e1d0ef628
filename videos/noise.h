#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace stride::videos {

/// Normally distributed numbers that are the same on every standard library: Box–Muller over
/// std::mt19937_64.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : engine_(seed) {}
  double operator()();

 private:
  std::mt19937_64 engine_;
};

/// Uniform in [0, 1), the same on every standard library.
double uniform(std::mt19937_64& engine);

/// Smooth random texture over the plane: values around 0 within ±1, features of about unit size,
/// repeating every 256 units. The same seed gives the same texture.
class Texture {
 public:
  explicit Texture(std::uint64_t seed);
  double operator()(double x, double y) const;
  /// Three octaves.
  double rough(double x, double y) const;

 private:
  std::vector<float> lattice_;
};

}  // namespace stride::videos
