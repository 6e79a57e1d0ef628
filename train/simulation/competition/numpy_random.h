#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace stride::competition {

/// Numpy's generator after `np.random.seed(seed)`, value by value; the competition drew its
/// obstacles from it.
class NumpyRandom {
 public:
  explicit NumpyRandom(std::uint32_t seed) : bits_(seed) {}

  /// [0, 1), 53 bits.
  double random() {
    const std::uint32_t high = bits_() >> 5, low = bits_() >> 6;
    return (high * 67108864.0 + low) / 9007199254740992.0;
  }

  double uniform(double low, double high) { return low + (high - low) * random(); }

  double exponential(double scale) { return -scale * std::log(1 - random()); }

  /// Marsaglia's polar method; the second value of a pair comes first.
  double normal(double mean, double sd) {
    if (have_spare_) {
      have_spare_ = false;
      return mean + sd * spare_;
    }
    double x, y, square;
    do {
      x = 2 * random() - 1;
      y = 2 * random() - 1;
      square = x * x + y * y;
    } while (square >= 1 || square == 0);
    const double factor = std::sqrt(-2 * std::log(square) / square);
    spare_ = factor * x;
    have_spare_ = true;
    return mean + sd * factor * y;
  }

 private:
  std::mt19937 bits_;
  double spare_ = 0;
  bool have_spare_ = false;
};

}  // namespace stride::competition
