#pragma once

#include <algorithm>
#include <opencv2/core.hpp>

namespace stride::videos {

using Colour = cv::Vec3f;  // blue, green, red, 0‥1

inline Colour rgb(int red, int green, int blue) {
  return {static_cast<float>(blue) / 255, static_cast<float>(green) / 255,
          static_cast<float>(red) / 255};
}

inline Colour mixed(const Colour& a, const Colour& b, double weight) {
  const auto w = static_cast<float>(weight);
  return a * (1 - w) + b * w;
}

inline Colour lit(const Colour& colour, double brightness) {
  return colour * static_cast<float>(brightness);
}

/// 0 below `edge`, 1 above, with a smooth transition of `width`.
inline double step(double x, double edge, double width) {
  const double t = std::clamp((x - edge) / width + 0.5, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// 1 between `low` and `high`, 0 outside.
inline double band(double x, double low, double high, double soft) {
  return step(x, low, soft) * (1 - step(x, high, soft));
}

}  // namespace stride::videos
