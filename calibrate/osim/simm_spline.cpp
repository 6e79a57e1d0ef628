#include "calibrate/osim/simm_spline.h"

#include <cstddef>

namespace stride::osim {
namespace {

/// c[i] = y''(x[i]) / 6, from the tridiagonal system of the conditions of continuity.
std::vector<double> sixths_of_second_derivatives(const std::vector<double>& x,
                                                 const std::vector<double>& y) {
  const std::size_t n = x.size(), last = n - 1;
  std::vector<double> width(n), slope(n), diagonal(n), right(n, 0.0);
  for (std::size_t i = 0; i < last; ++i) {
    width[i] = x[i + 1] - x[i];
    slope[i] = (y[i + 1] - y[i]) / width[i];
  }
  diagonal[0] = -width[0];
  diagonal[last] = -width[last - 1];
  for (std::size_t i = 1; i < last; ++i) {
    diagonal[i] = 2 * (width[i - 1] + width[i]);
    right[i] = slope[i] - slope[i - 1];
  }
  if (n > 3) {  // third divided differences of the four outermost points
    const auto second = [&](std::size_t i) { return right[i] / (x[i + 1] - x[i - 1]); };
    const double at_first = (second(2) - second(1)) / (x[3] - x[0]);
    const double at_last = (second(last - 1) - second(last - 2)) / (x[last] - x[last - 3]);
    right[0] = at_first * width[0] * width[0];
    right[last] = -at_last * width[last - 1] * width[last - 1];
  }
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = width[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * width[i - 1];
    right[i] -= factor * right[i - 1];
  }
  right[last] /= diagonal[last];
  for (std::size_t i = last; i-- > 0;)
    right[i] = (right[i] - width[i] * right[i + 1]) / diagonal[i];
  return right;
}

}  // namespace

SplineCoefficients spline_coefficients(const SimmSpline& spline) {
  const std::size_t n = spline.x.size();
  SplineCoefficients result{spline.x, spline.y, {}, {}, {}};
  result.b.assign(n, 0), result.c.assign(n, 0), result.d.assign(n, 0);
  if (n < 2) return result;
  const std::vector<double>& x = spline.x;
  const std::vector<double>& y = spline.y;
  const std::vector<double> s =
      n > 2 ? sixths_of_second_derivatives(x, y) : std::vector<double>(n, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double width = x[i + 1] - x[i];
    result.b[i] = (y[i + 1] - y[i]) / width - width * (s[i + 1] + 2 * s[i]);
    result.c[i] = 3 * s[i];
    result.d[i] = (s[i + 1] - s[i]) / width;
  }
  const double width = x[n - 1] - x[n - 2];
  result.b[n - 1] = (y[n - 1] - y[n - 2]) / width + width * (s[n - 2] + 2 * s[n - 1]);
  return result;
}

SplineValue evaluate_with_derivatives(const SplineCoefficients& spline, double x) {
  const int i = spline_interval(spline, x);
  if (i < 0) return {spline.y[0] + (x - spline.x[0]) * spline.b[0], spline.b[0], 0};
  const double h = x - spline.x[i], b = spline.b[i], c = spline.c[i], d = spline.d[i];
  if (i + 1 == static_cast<int>(spline.x.size())) return {spline.y[i] + h * b, b, 0};
  return {spline.y[i] + h * (b + h * (c + h * d)), b + h * (2 * c + 3 * h * d), 2 * c + 6 * h * d};
}

}  // namespace stride::osim
