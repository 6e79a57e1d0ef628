#include "extract/tracking/spline.h"

#include <Eigen/Dense>
#include <algorithm>

#include "extract/io/error.h"

namespace stride::tracking {
namespace {

using Slopes = std::vector<Eigen::Vector2d>;

/// Slopes at the points by the tridiagonal system of the spline whose first and last two pieces
/// are one polynomial each (de Boor, A Practical Guide to Splines, chapter IV).
Slopes not_a_knot_slopes(const std::vector<double>& t, const std::vector<Eigen::Vector2d>& p) {
  const std::size_t n = t.size();
  std::vector<double> lower(n, 0), diagonal(n, 0), upper(n, 0);
  Slopes right(n);
  const auto h = [&](std::size_t i) { return t[i + 1] - t[i]; };
  const auto secant = [&](std::size_t i) -> Eigen::Vector2d { return (p[i + 1] - p[i]) / h(i); };
  const double first = h(0) + h(1), last = h(n - 2) + h(n - 3);
  diagonal[0] = h(1);
  upper[0] = first;
  right[0] = ((h(0) + 2 * first) * h(1) * secant(0) + h(0) * h(0) * secant(1)) / first;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    lower[i] = h(i);
    diagonal[i] = 2 * (h(i - 1) + h(i));
    upper[i] = h(i - 1);
    right[i] = 3 * (h(i) * secant(i - 1) + h(i - 1) * secant(i));
  }
  lower[n - 1] = last;
  diagonal[n - 1] = h(n - 3);
  right[n - 1] =
      (h(n - 2) * h(n - 2) * secant(n - 3) + (2 * last + h(n - 2)) * h(n - 3) * secant(n - 2)) /
      last;
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = lower[i] / diagonal[i - 1];
    diagonal[i] -= factor * upper[i - 1];
    right[i] -= factor * right[i - 1];
  }
  Slopes slopes(n);
  slopes[n - 1] = right[n - 1] / diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;)
    slopes[i] = (right[i] - upper[i] * slopes[i + 1]) / diagonal[i];
  return slopes;
}

/// Slopes of the polynomial through at most three points.
Slopes polynomial_slopes(const std::vector<double>& t, const std::vector<Eigen::Vector2d>& p) {
  const std::size_t n = t.size();
  if (n == 1) return {Eigen::Vector2d::Zero()};
  const Eigen::Vector2d a = (p[1] - p[0]) / (t[1] - t[0]);
  if (n == 2) return {a, a};
  const Eigen::Vector2d b = (p[2] - p[1]) / (t[2] - t[1]);
  const Eigen::Vector2d curve = (b - a) / (t[2] - t[0]);
  return {a - curve * (t[1] - t[0]), a + curve * (t[1] - t[0]), b + curve * (t[2] - t[1])};
}

}  // namespace

Spline::Spline(std::vector<double> t, std::vector<Eigen::Vector2d> p)
    : t_(std::move(t)), p_(std::move(p)) {
  require(!t_.empty() && t_.size() == p_.size(), "spline: {} times and {} points", t_.size(),
          p_.size());
  slope_ = t_.size() < 4 ? polynomial_slopes(t_, p_) : not_a_knot_slopes(t_, p_);
}

Eigen::Vector2d Spline::operator()(double t) const {
  if (t <= t_.front()) return p_.front() + slope_.front() * (t - t_.front());
  if (t >= t_.back()) return p_.back() + slope_.back() * (t - t_.back());
  const std::size_t i =
      static_cast<std::size_t>(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin()) - 1;
  const double h = t_[i + 1] - t_[i], u = (t - t_[i]) / h, v = 1 - u;
  return v * v * (1 + 2 * u) * p_[i] + u * u * (1 + 2 * v) * p_[i + 1] +
         h * u * v * (v * slope_[i] - u * slope_[i + 1]);
}

}  // namespace stride::tracking
