#include "videos/noise.h"

#include <cmath>

#include "extract/io/random.h"

namespace stride::videos {
namespace {

constexpr int kSize = 256;

}  // namespace

Texture::Texture(std::uint64_t seed) : lattice_(kSize * kSize) {
  Random engine(seed);
  for (float& value : lattice_) value = static_cast<float>(2 * uniform(engine) - 1);
}

double Texture::operator()(double x, double y) const {
  const double column = std::floor(x), row = std::floor(y);
  double u = x - column, v = y - row;
  u *= u * (3 - 2 * u);
  v *= v * (3 - 2 * v);
  const int i = static_cast<int>(static_cast<std::int64_t>(column) & (kSize - 1));
  const int j = static_cast<int>(static_cast<std::int64_t>(row) & (kSize - 1));
  const int i1 = (i + 1) & (kSize - 1), j1 = (j + 1) & (kSize - 1);
  const double top = lattice_[j * kSize + i] * (1 - u) + lattice_[j * kSize + i1] * u;
  const double bottom = lattice_[j1 * kSize + i] * (1 - u) + lattice_[j1 * kSize + i1] * u;
  return top * (1 - v) + bottom * v;
}

double Texture::rough(double x, double y) const {
  return 0.57 * (*this)(x, y) + 0.29 * (*this)(2.1 * x + 17, 2.1 * y + 5) +
         0.14 * (*this)(4.3 * x + 31, 4.3 * y + 11);
}

}  // namespace stride::videos
