#include "extract/pose/crop.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/dnn/dnn.hpp>
#include <opencv2/imgproc.hpp>

namespace stride::pose {

using Eigen::Vector2d;

namespace {

constexpr double kRoom = 1.25;          // of a crop around a body
constexpr double kShrinkFrom_px = 1.5;  // image pixels a pixel of the input

/// The part of the image under the crop, smaller by a whole number; where (0, 0) of it lies.
struct Shrunk {
  cv::Mat image;
  Vector2d origin_px;
  double scale = 1;
};
Shrunk shrunk(const cv::Mat& bgr, const Crop& crop, double pixel) {
  const double reach =
      crop.size_px * (std::abs(std::cos(crop.angle_rad)) + std::abs(std::sin(crop.angle_rad))) / 2 +
      2 * pixel;
  const auto first = [&](double at, int most) {
    return std::clamp(static_cast<int>(std::floor(at - reach)), 0, most);
  };
  const cv::Point from(first(crop.centre_px.x(), bgr.cols), first(crop.centre_px.y(), bgr.rows));
  const auto factor = std::floor(pixel);
  const auto length = [&](double at, int begin, int size) {
    const int end = std::clamp(static_cast<int>(std::ceil(at + reach)), begin, size);
    return static_cast<int>(std::ceil((end - begin) / factor));
  };
  const cv::Size small(length(crop.centre_px.x(), from.x, bgr.cols),
                       length(crop.centre_px.y(), from.y, bgr.rows));
  if (small.empty()) return {bgr, Vector2d::Zero(), 1};
  // As many whole pixels as there are, the last row and column repeated.
  const cv::Rect inside = cv::Rect(from, cv::Size(small.width * static_cast<int>(factor),
                                                  small.height * static_cast<int>(factor))) &
                          cv::Rect({}, bgr.size());
  cv::Mat part = bgr(inside);
  cv::copyMakeBorder(part, part, 0, small.height * static_cast<int>(factor) - inside.height, 0,
                     small.width * static_cast<int>(factor) - inside.width, cv::BORDER_REPLICATE);
  Shrunk result;
  cv::resize(part, result.image, small, 0, 0, cv::INTER_AREA);
  result.scale = factor;
  result.origin_px = Vector2d(from.x, from.y).array() + (factor - 1) / 2;
  return result;
}

}  // namespace

Vector2d Crop::in_image(const Vector2d& share) const {
  return centre_px + Eigen::Rotation2Dd(angle_rad) * (size_px * (share.array() - 0.5)).matrix();
}

Crop crop_of_person(const Vector2d& centre_px, const Vector2d& above_px) {
  const Vector2d up = above_px - centre_px;
  return {centre_px, 2 * kRoom * up.norm(), std::atan2(up.x(), -up.y())};
}

Crop crop_of_image(const cv::Mat& image) {
  return {{(image.cols - 1) / 2.0, (image.rows - 1) / 2.0},
          static_cast<double>(std::max(image.cols, image.rows)),
          0};
}

cv::Mat shown(const cv::Mat& bgr, const Crop& crop, int side, double low, double high) {
  const double pixel = crop.size_px / side;
  Shrunk from{bgr, Vector2d::Zero(), 1};
  if (pixel > kShrinkFrom_px && pixel < std::max(bgr.cols, bgr.rows))
    from = shrunk(bgr, crop, std::max(pixel, 2.0));
  // The centre of the input's first pixel, and the steps to its neighbours.
  const double half = 0.5 / side;
  const Vector2d first = (crop.in_image({half, half}) - from.origin_px) / from.scale;
  const Vector2d right = Eigen::Rotation2Dd(crop.angle_rad) * Vector2d(pixel / from.scale, 0);
  const cv::Matx23d to_image(right.x(), -right.y(), first.x(), right.y(), right.x(), first.y());
  cv::Mat square;
  cv::warpAffine(from.image, square, to_image, {side, side},
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT);
  const double scale = (high - low) / 255;
  cv::Mat levels;
  square.convertTo(levels, CV_32F, scale, low);
  return cv::dnn::blobFromImage(levels, 1, {}, {}, true);
}

}  // namespace stride::pose
