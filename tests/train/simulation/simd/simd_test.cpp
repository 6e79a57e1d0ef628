#include "train/simulation/simd/simd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stride {
namespace {

TEST(Simd, ExponentialSineAndCosineAreThoseOfTheLibrary) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int n = 0; n < 20000; ++n) {
    const double range = n % 2 ? 1 : 30;
    const simd::V4 x{range * uniform(random), range * uniform(random), range * uniform(random),
                     range * uniform(random)};
    const simd::V4 e = simd::exp(x);
    simd::V4 s, c;
    simd::sin_cos(x, s, c);
    for (int i = 0; i < 4; ++i) {
      ASSERT_NEAR(e[i] / std::exp(x[i]), 1, 2e-15) << x[i];
      ASSERT_NEAR(s[i], std::sin(x[i]), 3e-16) << x[i];
      ASSERT_NEAR(c[i], std::cos(x[i]), 3e-16) << x[i];
    }
  }
}

TEST(Simd, ExponentialIsFiniteAtTheEnds) {
  const simd::V4 e = simd::exp(simd::V4{-1e9, 1e9, 0, -700});
  EXPECT_GE(e[0], 0);
  EXPECT_TRUE(std::isfinite(e[1]));
  EXPECT_EQ(e[2], 1);
  EXPECT_LT(e[3], 1e-300);
}

}  // namespace
}  // namespace stride
