#include "extract/annotation/session/draw.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace stride::annotation {
namespace {

constexpr int kShift = 4;  // fractional bits of OpenCV's drawing

cv::Point fixed(const Eigen::Vector2d& p) {
  const Eigen::Vector2d q = p.cwiseMax(-5000).cwiseMin(5000) * (1 << kShift);
  return {cvRound(q.x()), cvRound(q.y())};
}

std::string plain(const std::string& text) {
  std::string ascii;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c < 128) {
      ascii += text[i];
    } else if (c >= 0xC0) {
      // The signs that our messages use; of any other letter the place is kept.
      const std::string rest = text.substr(i, 3);
      ascii += rest.starts_with("…")   ? "..."
               : rest.starts_with("–") ? "-"
               : rest.starts_with("×") ? "x"
                                       : "?";
    }
  }
  return ascii;
}

}  // namespace

void draw_line(cv::Mat& canvas, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
               const cv::Scalar& colour, int thickness) {
  cv::line(canvas, fixed(from), fixed(to), colour, thickness, cv::LINE_AA, kShift);
}

void draw_dashes(cv::Mat& canvas, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                 const cv::Scalar& colour) {
  const double length = std::min((to - from).norm(), 4000.0);
  const Eigen::Vector2d along = (to - from) / std::max(length, 1.0);
  for (double s = 0; s < length; s += 9)
    draw_line(canvas, from + s * along, from + std::min(s + 4, length) * along, colour);
}

void draw_ring(cv::Mat& canvas, const Eigen::Vector2d& p, double radius, const cv::Scalar& colour,
               int thickness) {
  cv::circle(canvas, fixed(p), cvRound(radius * (1 << kShift)), colour, thickness, cv::LINE_AA,
             kShift);
}

void draw_dot(cv::Mat& canvas, const Eigen::Vector2d& p, double radius, const cv::Scalar& colour) {
  draw_ring(canvas, p, radius, colour, cv::FILLED);
}

void draw_text(cv::Mat& canvas, const std::string& text, const cv::Point& p,
               const cv::Scalar& colour, double size) {
  cv::putText(canvas, plain(text), p, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

int text_width(const std::string& text, double size) {
  int baseline = 0;
  return cv::getTextSize(plain(text), cv::FONT_HERSHEY_SIMPLEX, size, 1, &baseline).width;
}

cv::Scalar confidence_colour(double confidence) {
  const double c = std::clamp(confidence, 0.0, 1.0);
  return {70, 60 + 160 * std::min(1.0, 2 * c), 60 + 170 * std::min(1.0, 2 - 2 * c)};
}

void shade(cv::Mat& canvas, const cv::Rect& area, double remaining) {
  cv::Mat piece = canvas(area & cv::Rect({0, 0}, canvas.size()));
  piece.convertTo(piece, -1, remaining);
}

}  // namespace stride::annotation
