#include "extract/annotation/session/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "extract/annotation/asking.h"
#include "extract/annotation/checks.h"
#include "extract/annotation/session/draw.h"

namespace stride::annotation {
namespace {

constexpr int kLoupe = 208;        // side, canvas px
constexpr double kLoupeScale = 8;  // relative to the window, at most to an image pixel

}  // namespace

cv::Rect AnnotationCanvas::image_area(cv::Size canvas) {
  return {0, kHeadLine, canvas.width, timeline_top(canvas) - kHeadLine};
}

cv::Scalar AnnotationCanvas::colour(BodyPart part) const {
  if (part == BodyPart::pelvis) return colour::kMiddle;
  if (part == BodyPart::head) return colour::kHead;
  return is_near(part, s_.near_leg()) ? colour::kNear : colour::kFar;
}

cv::Mat AnnotationCanvas::draw() {
  canvas_ = cv::Mat(s_.options_.canvas_px, CV_8UC3, colour::kBackground);
  draw_image();
  draw_timeline();
  draw_head_line();
  draw_status();
  if (s_.help_) draw_help();
  return canvas_;
}

void AnnotationCanvas::draw_image() {
  cv::Mat area = canvas_(s_.view_.area);
  if (s_.shown_image().empty()) {
    draw_text(area, "decoding ...", {area.cols / 2 - 40, area.rows / 2}, colour::kDim, 0.6);
    return;
  }
  s_.shown_area().copyTo(area);
  // Shapes are drawn on the whole canvas; the rest of the canvas is painted over them afterwards.
  draw_floor();
  draw_calibration_line();
  draw_ghosts();
  draw_clicks();
  draw_loupe();
}

void AnnotationCanvas::draw_floor() {
  const auto& floor = s_.keypoints().floor;
  if (floor)
    draw_line(canvas_, s_.view_.to_canvas(floor->from_px), s_.view_.to_canvas(floor->to_px),
              colour::kGood, 1);
  if (s_.mode_ == AnnotationSession::Mode::floor_to)
    draw_dashes(canvas_, s_.view_.to_canvas(s_.floor_from_), s_.mouse_, colour::kGood);
}

/// With a tick at each end and its length, on its own frame; elsewhere the camera has moved.
void AnnotationCanvas::draw_calibration_line() {
  using Mode = AnnotationSession::Mode;
  const bool typing = s_.mode_ == Mode::type && s_.typing_.what == Command::calibration_line;
  if (s_.mode_ == Mode::length_to && s_.measured_.frame == s_.frame_)
    draw_dashes(canvas_, s_.view_.to_canvas(s_.measured_.from_px), s_.mouse_, colour::kAccent);
  std::optional<CalibrationLine> line = s_.keypoints().calibration_line;
  if (typing) line = s_.measured_;
  if (!line || line->frame != s_.frame_) return;
  const Eigen::Vector2d from = s_.view_.to_canvas(line->from_px),
                        to = s_.view_.to_canvas(line->to_px);
  const Eigen::Vector2d along = (to - from).normalized(), tick(-6 * along.y(), 6 * along.x());
  draw_line(canvas_, from, to, colour::kAccent, 1);
  for (const Eigen::Vector2d& end : {from, to})
    draw_line(canvas_, end - tick, end + tick, colour::kAccent, 1);
  const Eigen::Vector2d middle = 0.5 * (from + to);
  if (!typing)
    draw_text(canvas_, fmt::format("{:.4g} m", line->length_m),
              {static_cast<int>(middle.x()) + 8, static_cast<int>(middle.y()) - 8},
              colour::kAccent);
}

void AnnotationCanvas::draw_ghosts() {
  const ClickedFrame* here = s_.clicked(s_.frame_);
  const auto is_placed = [&](BodyPart part) { return here && here->placed(part); };
  const TrajectoryFrame* now = s_.predicted(s_.frame_);
  const auto pelvis = [&]() -> std::optional<Eigen::Vector2d> {
    if (is_placed(BodyPart::pelvis)) return (*here)[BodyPart::pelvis]->p_px;
    if (now && (*now)[BodyPart::pelvis].present()) return (*now)[BodyPart::pelvis].p_px;
    return std::nullopt;
  }();

  // The same phase of the previous stride, moved to this frame's pelvis.
  const auto before = static_cast<int>(std::lround(s_.frame_ - s_.stride_frames()));
  if (const TrajectoryFrame* ghost = s_.predicted(before);
      ghost && pelvis && (*ghost)[BodyPart::pelvis].present()) {
    const Eigen::Vector2d move = *pelvis - (*ghost)[BodyPart::pelvis].p_px;
    for (const auto& [a, b] : kBones)
      if ((*ghost)[a].present() && (*ghost)[b].present())
        draw_dashes(canvas_, s_.view_.to_canvas((*ghost)[a].p_px + move),
                    s_.view_.to_canvas((*ghost)[b].p_px + move), colour(b) * 0.75);
  }
  if (!now) return;
  for (const BodyPart part : kBodyParts) {
    const Point& point = (*now)[part];
    if (!point.present() || is_placed(part)) continue;
    const Eigen::Vector2d p = s_.view_.to_canvas(point.p_px);
    draw_ring(canvas_, p, 7, colour(part));
    draw_ring(canvas_, p, 3, confidence_colour(point.confidence), 2);
  }
  const auto line = [&](const Bone& bone) {
    const auto& [a, b] = bone;
    if ((*now)[a].present() && (*now)[b].present() && !(is_placed(a) && is_placed(b)))
      draw_line(canvas_, s_.view_.to_canvas((*now)[a].p_px), s_.view_.to_canvas((*now)[b].p_px),
                colour(b) * 0.7);
  };
  std::ranges::for_each(kBones, line);
  std::ranges::for_each(kSoles, line);
}

void AnnotationCanvas::draw_clicks() {
  const ClickedFrame* here = s_.clicked(s_.frame_);
  if (!here) return;
  const auto place = [&](BodyPart part) {
    Eigen::Vector2d p = s_.view_.to_canvas((*here)[part]->p_px);
    if (s_.grip_.what == AnnotationSession::Grip::What::point && s_.grip_.part == part &&
        s_.grip_.moved)
      p += s_.mouse_ - s_.grip_.from_canvas;
    return p;
  };
  const auto warnings = bone_warnings(s_.keypoints(), s_.frame_);
  for (const auto& [a, b] : kBones) {
    if (!here->placed(a) || !here->placed(b)) continue;
    const bool wrong = std::ranges::any_of(
        warnings, [a = a, b = b](const BoneWarning& w) { return w.from == a && w.to == b; });
    draw_line(canvas_, place(a), place(b), wrong ? colour::kWrong : colour(b), 2);
    if (wrong)
      draw_text(canvas_, "length?",
                {cvRound((place(a).x() + place(b).x()) / 2) + 8,
                 cvRound((place(a).y() + place(b).y()) / 2)},
                colour::kWrong, 0.4);
  }
  for (const BodyPart part : kBodyParts) {
    if (!here->placed(part)) continue;
    const Eigen::Vector2d p = place(part);
    if ((*here)[part]->state == ClickState::seen) {
      draw_dot(canvas_, p, 3.5, colour(part));
    } else {
      draw_dot(canvas_, p, 1.5, colour(part));
    }
    draw_ring(canvas_, p, 6, part == s_.last_ ? colour::kAccent : colour::kBackground, 1);
    draw_ring(canvas_, p, 5, colour(part), 1);
  }
}

void AnnotationCanvas::draw_loupe() {
  if (!s_.view_.contains(s_.mouse_) || s_.view_.scale >= kLoupeScale || s_.shown_image().empty())
    return;
  const cv::Rect area = s_.view_.area;
  cv::Rect place(area.width - kLoupe - 10, area.y + 10, kLoupe, kLoupe);
  if (s_.mouse_.x() > place.x - 40 && s_.mouse_.y() < place.y + kLoupe + 40) place.x = 10;
  const double scale = kLoupeScale * std::min(s_.view_.scale, 1.0);
  View loupe{s_.view_.image_px, place, scale, {}};
  loupe.p0_px = s_.view_.to_image(s_.mouse_) - Eigen::Vector2d(kLoupe, kLoupe) / 2 / scale;
  cv::Mat piece = loupe.piece_of(s_.shown_image());
  const Eigen::Vector2d centre(kLoupe / 2.0 - 0.5, kLoupe / 2.0 - 0.5);
  const ClickedFrame* here = s_.clicked(s_.frame_);
  for (const BodyPart part : kBodyParts)
    if (here && here->placed(part))
      draw_ring(piece, loupe.to_canvas((*here)[part]->p_px) - Eigen::Vector2d(place.x, place.y), 5,
                colour(part), 1);
  const cv::Scalar cross = s_.asked_ ? colour(*s_.asked_) : colour::kMiddle;
  for (const Eigen::Vector2d& axis : {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)})
    for (const double side : {-1.0, 1.0})
      draw_line(piece, centre + side * 6 * axis, centre + side * 26 * axis, cross);
  piece.copyTo(canvas_(place));
  cv::rectangle(canvas_, place, colour::kLine, 1);
}

}  // namespace stride::annotation
