#include "extract/annotation/session/view.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "extract/annotation/session/draw.h"

namespace stride::annotation {
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

Eigen::Vector2d View::inside(const Eigen::Vector2d& image) const {
  return {std::clamp(image.x(), -0.5, image_px.width - 0.5),
          std::clamp(image.y(), -0.5, image_px.height - 0.5)};
}

bool View::contains(const Eigen::Vector2d& canvas) const {
  const Eigen::Vector2d p = canvas - corner(area);
  return p.x() >= 0 && p.y() >= 0 && p.x() < area.width && p.y() < area.height;
}

cv::Mat View::piece_of(const cv::Mat& image) const {
  // warpAffine maps centres of pixels to centres of pixels, as to_canvas() does.
  const Eigen::Vector2d origin = to_canvas({0, 0}) - Eigen::Vector2d(area.x, area.y);
  const auto warp = [&](const cv::Mat& from, double by, const Eigen::Vector2d& at, int how) {
    cv::Mat piece;
    cv::warpAffine(from, piece, cv::Matx23d(by, 0, at.x(), 0, by, at.y()), area.size(), how,
                   cv::BORDER_CONSTANT, colour::kBackground);
    return piece;
  };
  if (scale >= 0.75)
    return warp(image, scale, origin, scale >= 6 ? cv::INTER_NEAREST : cv::INTER_LINEAR);
  cv::Mat small;
  cv::resize(image, small, {}, scale, scale, cv::INTER_AREA);
  return warp(small, 1, origin + kHalf * (1 - scale), cv::INTER_LINEAR);
}

double View::fitting_scale() const {
  return std::min(area.width / static_cast<double>(image_px.width),
                  area.height / static_cast<double>(image_px.height));
}

void View::fit() {
  scale = fitting_scale();
  keep_in_view();
}

void View::zoom(double new_scale, const Eigen::Vector2d& canvas) {
  const Eigen::Vector2d fixed = to_image(canvas);
  scale = std::clamp(new_scale, fitting_scale(), std::max(kLargestScale, fitting_scale()));
  p0_px = fixed - (canvas - corner(area)) / scale;
  keep_in_view();
}

void View::pan(const Eigen::Vector2d& canvas_move) {
  p0_px -= canvas_move / scale;
  keep_in_view();
}

void View::keep_in_view() {
  const Eigen::Vector2d image(image_px.width, image_px.height);
  const Eigen::Vector2d seen = Eigen::Vector2d(area.width, area.height) / scale;
  for (int i = 0; i < 2; ++i)
    p0_px[i] = seen[i] >= image[i] ? (image[i] - seen[i]) / 2 - 0.5
                                   : std::clamp(p0_px[i], -0.5, image[i] - seen[i] - 0.5);
}

}  // namespace stride::annotation
