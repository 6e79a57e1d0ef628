#pragma once

#include <cstdint>
#include <vector>

namespace stride::videos {

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
