#pragma once

// C++17-clean and free of Eigen: the Simbody engine includes it.

#include <algorithm>
#include <vector>

#include "calibrate/osim/model.h"

namespace stride::osim {

/// The polynomials of a SimmSpline: on [x[i], x[i+1]] with h = x - x[i],
/// y = y[i] + h (b[i] + h (c[i] + h d[i])); a straight line of the end's slope outside.
struct SplineCoefficients {
  std::vector<double> x, y, b, c, d;
};

struct SplineValue {
  double value = 0, first = 0, second = 0;  // and derivatives by x
};

/// The coefficients of OpenSim's SimmSpline, which is that of Forsythe, Malcolm and Moler (1977,
/// §4.4): the third derivative at either end is that of the cubic through the four outermost
/// points. A single point is a constant, two are a line.
SplineCoefficients spline_coefficients(const SimmSpline& spline);

/// Index of the polynomial at x; -1 before the first point, the last index after the last point.
inline int spline_interval(const SplineCoefficients& spline, double x) {
  if (x < spline.x.front()) return -1;
  const auto after = std::upper_bound(spline.x.begin(), spline.x.end(), x);
  return static_cast<int>(after - spline.x.begin()) - 1;
}

/// The value at x. `x_value` is x as a double; T is double or an automatic-differentiation type
/// such as ceres::Jet.
template <typename T>
T evaluate(const SplineCoefficients& spline, const T& x, double x_value) {
  const int i = spline_interval(spline, x_value);
  if (i < 0) return spline.y[0] + (x - spline.x[0]) * spline.b[0];
  const T h = x - spline.x[i];
  if (i + 1 == static_cast<int>(spline.x.size())) return spline.y[i] + h * spline.b[i];
  return spline.y[i] + h * (spline.b[i] + h * (spline.c[i] + h * spline.d[i]));
}

inline double evaluate(const SplineCoefficients& spline, double x) {
  return evaluate(spline, x, x);
}

/// The same for a ceres::Jet, whose value is its member `a`.
template <typename Jet>
auto evaluate(const SplineCoefficients& spline, const Jet& x) -> decltype(x.a, Jet(x)) {
  return evaluate(spline, x, x.a);
}

SplineValue evaluate_with_derivatives(const SplineCoefficients& spline, double x);

}  // namespace stride::osim
