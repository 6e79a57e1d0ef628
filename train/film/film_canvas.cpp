#include "train/film/film_canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace stride::film {
namespace {

constexpr int kShift = 4;  // fractional bits of OpenCV's drawing coordinates

cv::Point fixed(const cv::Point2d& p) {
  return {static_cast<int>(std::lround(p.x * (1 << kShift))),
          static_cast<int>(std::lround(p.y * (1 << kShift)))};
}

}  // namespace

cv::Scalar mixed(const cv::Scalar& a, const cv::Scalar& b, double weight) {
  return a * (1 - weight) + b * weight;
}

simulation::PlanarVector between(simulation::PlanarVector a, simulation::PlanarVector b, double w) {
  return {a.x + w * (b.x - a.x), a.y + w * (b.y - a.y)};
}

Canvas::Canvas(cv::Size size_px, double metres_high, double centre_x_m)
    : picture_(size_px * kOversampling, CV_8UC3),
      scale_(kOversampling * size_px.height / metres_high),
      centre_x_m_(centre_x_m) {}

cv::Point2d Canvas::place(simulation::PlanarVector p) const {
  return {picture_.cols / 2.0 + (p.x - centre_x_m_) * scale_,
          picture_.rows * kGroundRow - p.y * scale_};
}

void Canvas::disc(simulation::PlanarVector p, double radius_m, const cv::Scalar& colour,
                  int rim_px) {
  cv::circle(picture_, fixed(place(p)),
             static_cast<int>(std::lround(radius_m * scale_ * (1 << kShift))), colour, rim_px,
             cv::LINE_AA, kShift);
}

void Canvas::shape(const std::vector<simulation::PlanarVector>& outline, const cv::Scalar& colour) {
  std::vector<cv::Point> points;
  for (const simulation::PlanarVector& p : outline) points.push_back(fixed(place(p)));
  cv::fillPoly(picture_, std::vector<std::vector<cv::Point>>{points}, colour, cv::LINE_AA, kShift);
}

void Canvas::line(simulation::PlanarVector a, simulation::PlanarVector b, double width_m,
                  const cv::Scalar& colour) {
  cv::line(picture_, fixed(place(a)), fixed(place(b)), colour,
           std::max(1, static_cast<int>(std::lround(width_m * scale_))), cv::LINE_AA, kShift);
}

void Canvas::bone(simulation::PlanarVector a, simulation::PlanarVector b, double end_m,
                  double waist_m, const cv::Scalar& fill, const cv::Scalar& rim) {
  const double length = std::max(1e-9, std::hypot(b.x - a.x, b.y - a.y));
  const simulation::PlanarVector n{-(b.y - a.y) / length, (b.x - a.x) / length};
  for (const double grown : {0.006, 0.0}) {
    const cv::Scalar& colour = grown > 0 ? rim : fill;
    std::vector<simulation::PlanarVector> outline;
    for (const int side : {1, -1})
      for (int i = 0; i <= 16; ++i) {
        const double w = side > 0 ? i / 16.0 : 1 - i / 16.0;
        const double waist = std::pow(std::sin(std::numbers::pi * w), 0.6);
        const double half = end_m + (waist_m - end_m) * waist + grown;
        const simulation::PlanarVector p = between(a, b, w);
        outline.push_back({p.x + side * half * n.x, p.y + side * half * n.y});
      }
    disc(a, end_m * 1.15 + grown, colour);
    disc(b, end_m * 1.15 + grown, colour);
    shape(outline, colour);
  }
}

void Canvas::flesh(simulation::PlanarVector a, simulation::PlanarVector b, double radius_a_m,
                   double radius_b_m, const cv::Scalar& colour) {
  const double length = std::max(1e-9, std::hypot(b.x - a.x, b.y - a.y));
  const simulation::PlanarVector n{-(b.y - a.y) / length, (b.x - a.x) / length};
  const double ra = radius_a_m, rb = radius_b_m;
  disc(a, ra, colour);
  disc(b, rb, colour);
  shape({{a.x + ra * n.x, a.y + ra * n.y},
         {b.x + rb * n.x, b.y + rb * n.y},
         {b.x - rb * n.x, b.y - rb * n.y},
         {a.x - ra * n.x, a.y - ra * n.y}},
        colour);
}

void Canvas::muscle(const std::vector<simulation::PlanarVector>& path, double belly_m,
                    const cv::Scalar& colour) {
  std::vector<double> from_start{0};
  for (std::size_t i = 1; i < path.size(); ++i)
    from_start.push_back(from_start.back() +
                         std::hypot(path[i].x - path[i - 1].x, path[i].y - path[i - 1].y));
  const double length = from_start.back();
  constexpr double kTendon_m = 0.005;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double piece = from_start[i] - from_start[i - 1];
    const int steps = 1 + static_cast<int>(piece / 0.004);
    for (int k = 0; k <= steps; ++k) {
      const double w = static_cast<double>(k) / steps;
      const double along = (from_start[i - 1] + w * piece) / length;
      const double swell =
          std::pow(std::sin(std::numbers::pi * std::clamp(along * 1.15, 0.0, 1.0)), 1.6);
      disc(between(path[i - 1], path[i], w), kTendon_m + (belly_m - kTendon_m) * swell, colour);
    }
  }
}

}  // namespace stride::film
