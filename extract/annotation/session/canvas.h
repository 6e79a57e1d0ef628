#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "extract/annotation/session/session.h"

namespace stride::annotation {

/// Draws a session: the image with points, ghosts and a loupe, the timeline, and a status line that
/// says what a click will do.
class AnnotationCanvas {
 public:
  explicit AnnotationCanvas(AnnotationSession& session) : s_(session) {}

  cv::Mat draw();

  /// The part of a canvas that shows the image.
  static cv::Rect image_area(cv::Size canvas);
  /// The frame at a canvas point in the timeline; nothing elsewhere.
  static std::optional<int> frame_at(const Eigen::Vector2d& p, cv::Size canvas, int frame_count);

 private:
  static constexpr int kHeadLine = 26, kStatus = 30, kTimeline = 170;  // heights
  static int timeline_top(cv::Size canvas) { return canvas.height - kStatus - kTimeline; }

  void draw_image();
  void draw_floor();
  void draw_calibration_line();
  void draw_ghosts();
  void draw_clicks();
  void draw_loupe();
  void draw_timeline();
  void draw_ankles(const cv::Rect& lane);
  void draw_head_line();
  void draw_status();
  void draw_help();
  std::string what_a_click_does() const;

  double x_of(double frame) const;
  cv::Scalar colour(BodyPart part) const;

  AnnotationSession& s_;
  cv::Mat canvas_;
};

}  // namespace stride::annotation
