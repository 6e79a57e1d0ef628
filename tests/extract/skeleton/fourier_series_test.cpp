#include "extract/skeleton/fourier_series.h"

#include <gtest/gtest.h>

namespace stride {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

TEST(FourierSeries, HasTheTermsOfItsFormula) {
  for (const double phase : {-0.7, 0.0, 0.125, 0.4, 3.3}) {
    const Eigen::VectorXd basis = fourier_basis(phase, 4);
    ASSERT_EQ(basis.size(), 9);
    EXPECT_EQ(basis[0], 1);
    for (int h = 1; h <= 4; ++h) {
      EXPECT_NEAR(basis[2 * h - 1], std::cos(kTurn * h * phase), 1e-13);
      EXPECT_NEAR(basis[2 * h], std::sin(kTurn * h * phase), 1e-13);
    }
    std::array<double, 8> waves{};
    fourier_waves(kTurn * phase, waves);
    for (int k = 0; k < 8; ++k) EXPECT_NEAR(waves[k], basis[k + 1], 1e-13);
  }
}

TEST(FourierSeries, IsTheSumOfItsTerms) {
  const FourierSeries<3> c{0.3, -1.2, 0.7, 0.05, 0.4, -0.6, 0.9};
  for (int harmonics = 0; harmonics <= 3; ++harmonics)
    for (const double phase : {-0.31, 0.0, 0.6, 2.2}) {
      const Eigen::VectorXd basis = fourier_basis(phase, harmonics);
      EXPECT_NEAR(evaluate_series(c.data(), harmonics, phase),
                  basis.dot(Eigen::Map<const Eigen::VectorXd>(c.data(), basis.size())), 1e-13);
    }
}

}  // namespace
}  // namespace stride
