#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <string>

namespace stride::annotation {

/// Colours of the window, BGR.
namespace colour {
inline const cv::Scalar kBackground(30, 28, 26), kPanel(44, 41, 38), kLine(80, 76, 72);
inline const cv::Scalar kText(235, 232, 228), kDim(150, 146, 142), kWrong(90, 110, 255);
inline const cv::Scalar kGood(120, 200, 120), kNear(60, 150, 255), kFar(245, 190, 70);
inline const cv::Scalar kMiddle(240, 240, 240), kHead(140, 230, 140), kAccent(90, 230, 250);
}  // namespace colour

/// Shapes at sub-pixel positions; `p` in canvas pixels.
void draw_line(cv::Mat& canvas, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
               const cv::Scalar& colour, int thickness = 1);
void draw_dashes(cv::Mat& canvas, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                 const cv::Scalar& colour);
void draw_ring(cv::Mat& canvas, const Eigen::Vector2d& p, double radius, const cv::Scalar& colour,
               int thickness = 1);
void draw_dot(cv::Mat& canvas, const Eigen::Vector2d& p, double radius, const cv::Scalar& colour);

/// Text with its baseline at `p`. OpenCV's fonts are ASCII; other characters are replaced.
void draw_text(cv::Mat& canvas, const std::string& text, const cv::Point& p,
               const cv::Scalar& colour, double size = 0.45);
int text_width(const std::string& text, double size = 0.45);

/// Red at 0, yellow at 0.5, green at 1.
cv::Scalar confidence_colour(double confidence);

/// Darkens a rectangle of the canvas, for text on it.
void shade(cv::Mat& canvas, const cv::Rect& area, double remaining);

}  // namespace stride::annotation
