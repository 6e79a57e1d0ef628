#include "extract/annotation/view.h"

#include <algorithm>

namespace stride {
namespace {

constexpr double kLargestScale = 32;
const Eigen::Vector2d kHalf(0.5, 0.5);

Eigen::Vector2d corner(const cv::Rect& area) { return Eigen::Vector2d(area.x, area.y) - kHalf; }

}  // namespace

// p0_px and corner() are corners of pixels, half a pixel before their centres.
Eigen::Vector2d View::to_canvas(const Eigen::Vector2d& image) const {
  return corner(area) + scale * (image - p0_px);
}

Eigen::Vector2d View::to_image(const Eigen::Vector2d& canvas) const {
  return p0_px + (canvas - corner(area)) / scale;
}

bool View::contains(const Eigen::Vector2d& canvas) const {
  const Eigen::Vector2d p = canvas - corner(area);
  return p.x() >= 0 && p.y() >= 0 && p.x() < area.width && p.y() < area.height;
}

double View::fitting_scale() const {
  return std::min(area.width / static_cast<double>(image_px.width),
                  area.height / static_cast<double>(image_px.height));
}

void View::fit() {
  scale = fitting_scale();
  keep_in_sight();
}

void View::zoom(double new_scale, const Eigen::Vector2d& canvas) {
  const Eigen::Vector2d fixed = to_image(canvas);
  scale = std::clamp(new_scale, fitting_scale(), std::max(kLargestScale, fitting_scale()));
  p0_px = fixed - (canvas - corner(area)) / scale;
  keep_in_sight();
}

void View::pan(const Eigen::Vector2d& canvas_move) {
  p0_px -= canvas_move / scale;
  keep_in_sight();
}

void View::keep_in_sight() {
  const Eigen::Vector2d image(image_px.width, image_px.height);
  const Eigen::Vector2d seen = Eigen::Vector2d(area.width, area.height) / scale;
  for (int i = 0; i < 2; ++i)
    p0_px[i] = seen[i] >= image[i] ? (image[i] - seen[i]) / 2 - 0.5
                                   : std::clamp(p0_px[i], -0.5, image[i] - seen[i] - 0.5);
}

}  // namespace stride
