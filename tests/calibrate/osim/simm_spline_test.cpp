#include "calibrate/osim/simm_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "extract/io/table.h"

namespace stride {
namespace {

const std::filesystem::path kRecordings = STRIDE_TEST_DATA;

osim::Model runner() { return osim::load_osim(osim::default_model_file()); }

const osim::TransformAxis& knee_translation(const osim::Model& model, int axis) {
  for (const osim::Joint& joint : model.joints)
    if (joint.name == "knee_r") return joint.transform[3 + axis];
  throw std::logic_error("no knee_r");
}

// Every figure was recorded from OpenSim 4.0 with twelve digits; the angles reach beyond the
// spline on either side.
TEST(SimmSpline, IsOpenSimsSimmSplineAndItsDerivative) {
  const osim::Model model = runner();
  const Table recorded = load_csv(kRecordings / "opensim_knee_kinematics.csv");
  ASSERT_GT(recorded.rows.size(), 150u);
  for (int axis : {0, 1}) {
    const osim::SplineCoefficients spline =
        osim::spline_coefficients(knee_translation(model, axis).spline);
    for (const std::vector<double>& row : recorded.rows) {
      const osim::SplineValue found = osim::evaluate_with_derivatives(spline, row[0]);
      EXPECT_NEAR(found.value, row[1 + axis], 1e-12) << "knee at " << row[0];
      EXPECT_NEAR(found.first, row[3 + axis], 1e-12) << "knee at " << row[0];
      EXPECT_EQ(osim::evaluate(spline, row[0]), found.value);
    }
  }
}

TEST(SimmSpline, SecondDerivativeIsThatOfTheFirst) {
  const osim::SplineCoefficients spline =
      osim::spline_coefficients(knee_translation(runner(), 0).spline);
  const double step = 1e-6;
  for (double x = -2.3; x < 2.3; x += 0.0371) {
    const double difference = (osim::evaluate_with_derivatives(spline, x + step).first -
                               osim::evaluate_with_derivatives(spline, x - step).first) /
                              (2 * step);
    EXPECT_NEAR(osim::evaluate_with_derivatives(spline, x).second, difference, 1e-6) << "at " << x;
  }
}

TEST(SimmSpline, ReproducesACubicBecauseOfItsEndConditions) {
  const auto cubic = [](double x) { return 2 - x + 0.5 * x * x - 0.25 * x * x * x; };
  osim::SimmSpline spline;
  for (double x : {-1.0, -0.2, 0.1, 0.9, 1.5}) spline.x.push_back(x), spline.y.push_back(cubic(x));
  const osim::SplineCoefficients coefficients = osim::spline_coefficients(spline);
  for (double x = -1; x < 1.5; x += 0.01)
    EXPECT_NEAR(osim::evaluate(coefficients, x), cubic(x), 1e-14);
}

TEST(SimmSpline, OfOnePointIsAConstantAndOfTwoALine) {
  const osim::SplineCoefficients constant = osim::spline_coefficients({{0}, {3}});
  EXPECT_EQ(osim::evaluate(constant, -7.0), 3);
  EXPECT_EQ(osim::evaluate_with_derivatives(constant, 7).first, 0);
  const osim::SplineCoefficients line = osim::spline_coefficients({{0, 2}, {1, 5}});
  for (double x : {-1.0, 0.5, 2.0, 4.0}) EXPECT_DOUBLE_EQ(osim::evaluate(line, x), 1 + 2 * x);
}

struct Dual {  // the shape of ceres::Jet
  double a = 0, v = 0;
  friend Dual operator-(const Dual& x, double y) { return {x.a - y, x.v}; }
  friend Dual operator+(double x, const Dual& y) { return {x + y.a, y.v}; }
  friend Dual operator*(const Dual& x, const Dual& y) { return {x.a * y.a, x.v * y.a + x.a * y.v}; }
  friend Dual operator*(const Dual& x, double y) { return {x.a * y, x.v * y}; }
};

TEST(SimmSpline, CarriesDerivativesThroughATypeOfAutomaticDifferentiation) {
  const osim::SplineCoefficients spline =
      osim::spline_coefficients(knee_translation(runner(), 1).spline);
  for (double x : {-2.5, -2.0944, -1.0, 0.0, 0.159149, 1.9, 2.0944, 2.4}) {
    const Dual found = osim::evaluate(spline, Dual{x, 1});
    const osim::SplineValue expected = osim::evaluate_with_derivatives(spline, x);
    EXPECT_DOUBLE_EQ(found.a, expected.value);
    EXPECT_NEAR(found.v, expected.first, 1e-15);
  }
}

}  // namespace
}  // namespace stride
