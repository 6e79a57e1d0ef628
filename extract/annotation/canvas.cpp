#include "extract/annotation/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "extract/annotation/asking.h"
#include "extract/annotation/checks.h"
#include "extract/annotation/draw.h"

namespace stride {
namespace {

constexpr int kHeadLine = 26, kStatus = 30, kTimeline = 170, kMargin = 96;
constexpr int kRuler = 18, kStrip = 12;
constexpr int kLoupe = 208;  // side, canvas px
constexpr double kLoupeScale = 8;

int timeline_top(cv::Size canvas) { return canvas.height - kStatus - kTimeline; }

}  // namespace

cv::Rect AnnotationCanvas::image_area(cv::Size canvas) {
  return {0, kHeadLine, canvas.width, timeline_top(canvas) - kHeadLine};
}

std::optional<int> AnnotationCanvas::frame_at(const Eigen::Vector2d& p, cv::Size canvas,
                                              int frame_count) {
  const int top = timeline_top(canvas);
  if (p.y() < top || p.y() >= top + kTimeline || frame_count < 1) return std::nullopt;
  const double width = canvas.width - kMargin - 12;
  const double frame = std::floor((p.x() - kMargin) / width * frame_count);
  if (frame < -1 || frame > frame_count) return std::nullopt;
  return std::clamp(static_cast<int>(frame), 0, frame_count - 1);
}

double AnnotationCanvas::x_of(double frame) const {
  return kMargin + (frame + 0.5) / std::max(s_.frame_count(), 1) *
                       (s_.options_.canvas_px.width - kMargin - 12);
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
  const View& view = s_.view_;
  cv::Mat area = canvas_(view.area);
  const cv::Mat image = s_.shown_image();
  if (image.empty()) {
    draw_text(area, "decoding ...", {area.cols / 2 - 40, area.rows / 2}, colour::kDim, 0.6);
    return;
  }
  // warpAffine maps centres of pixels to centres of pixels, as View does.
  const Eigen::Vector2d origin = view.to_canvas({0, 0}) - Eigen::Vector2d(view.area.x, view.area.y);
  const cv::Matx23d matrix(view.scale, 0, origin.x(), 0, view.scale, origin.y());
  if (view.scale < 0.75) {
    cv::Mat small;
    cv::resize(image, small, {}, view.scale, view.scale, cv::INTER_AREA);
    const cv::Matx23d shift(1, 0, origin.x() + 0.5 - view.scale / 2, 0, 1,
                            origin.y() + 0.5 - view.scale / 2);
    cv::warpAffine(small, area, shift, area.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT,
                   colour::kBackground);
  } else {
    cv::warpAffine(image, area, matrix, area.size(),
                   view.scale >= 6 ? cv::INTER_NEAREST : cv::INTER_LINEAR, cv::BORDER_CONSTANT,
                   colour::kBackground);
  }
  // Shapes are drawn on the whole canvas; what sticks out of the area is covered afterwards.
  draw_floor();
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

void AnnotationCanvas::draw_ghosts() {
  const ClickedFrame* here = s_.clicked(s_.frame_);
  const auto is_placed = [&](BodyPart part) { return here && here->placed(part); };
  const TrajectoryFrame* now = s_.predicted(s_.frame_);
  const auto pelvis = [&]() -> std::optional<Eigen::Vector2d> {
    if (is_placed(BodyPart::pelvis)) return (*here)[BodyPart::pelvis]->p_px;
    if (now && (*now)[BodyPart::pelvis].present()) return (*now)[BodyPart::pelvis].p_px;
    return std::nullopt;
  }();

  // The same phase of the stride before, moved onto this frame's pelvis.
  const auto before = static_cast<int>(std::lround(s_.frame_ - s_.stride_frames()));
  if (const TrajectoryFrame* ghost = s_.predicted(before);
      ghost && pelvis && (*ghost)[BodyPart::pelvis].present()) {
    const Eigen::Vector2d move = *pelvis - (*ghost)[BodyPart::pelvis].p_px;
    for (const auto& [a, b] : bones())
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
  for (const auto& [a, b] : bones())
    if ((*now)[a].present() && (*now)[b].present() && !(is_placed(a) && is_placed(b)))
      draw_line(canvas_, s_.view_.to_canvas((*now)[a].p_px), s_.view_.to_canvas((*now)[b].p_px),
                colour(b) * 0.7);
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
  for (const auto& [a, b] : bones()) {
    if (!here->placed(a) || !here->placed(b)) continue;
    const bool wrong = std::ranges::any_of(
        warnings, [&](const BoneWarning& w) { return w.from == a && w.to == b; });
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
  View loupe{s_.view_.image_px, place, kLoupeScale, {}};
  loupe.p0_px = s_.view_.to_image(s_.mouse_) - Eigen::Vector2d(kLoupe, kLoupe) / 2 / kLoupeScale;
  const Eigen::Vector2d origin = loupe.to_canvas({0, 0}) - Eigen::Vector2d(place.x, place.y);
  cv::Mat piece;
  cv::warpAffine(s_.shown_image(), piece,
                 cv::Matx23d(kLoupeScale, 0, origin.x(), 0, kLoupeScale, origin.y()), place.size(),
                 cv::INTER_LINEAR, cv::BORDER_CONSTANT, colour::kBackground);
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

void AnnotationCanvas::draw_timeline() {
  const cv::Size size = s_.options_.canvas_px;
  const int top = timeline_top(size);
  canvas_({0, top, size.width, size.height - top}).setTo(colour::kPanel);
  const Keypoints& k = s_.keypoints();
  const int count = s_.frame_count(), bottom = top + kTimeline - 4;
  const auto box = [&](double from, double to, int y, int height, const cv::Scalar& c) {
    const int x = cvRound(x_of(from - 0.5)), width = std::max(1, cvRound(x_of(to + 0.5)) - x);
    cv::rectangle(canvas_, cv::Rect(x, y, width, height), c, cv::FILLED);
  };

  if (s_.range_from_)
    box(std::min(*s_.range_from_, s_.frame_), std::max(*s_.range_from_, s_.frame_), top, kTimeline,
        colour::kPanel * 1.6);
  // Ruler: frames ten by ten, clicked frames as diamonds, suspected swaps as crosses.
  for (int f = 0; f < count; f += 10) {
    const int x = cvRound(x_of(f));
    cv::line(canvas_, {x, top + 12}, {x, top + kRuler}, colour::kLine);
    if (f % (count > 600 ? 200 : count > 150 ? 50 : 20) == 0)
      draw_text(canvas_, std::to_string(f), {x + 3, top + 12}, colour::kDim, 0.33);
  }
  for (const auto& [number, frame] : k.frames) {
    const auto x = x_of(number);
    const bool complete = !next_missing(k, number, s_.order(), std::nullopt);
    for (int d = 0; d < 4; ++d) {
      const cv::Scalar c = complete ? colour::kAccent : colour::kDim;
      draw_line(canvas_, {x - 3 + d, top + kRuler - 4.0 - d}, {x - 3 + d, top + kRuler - 4.0 + d},
                c);
      draw_line(canvas_, {x + 3 - d, top + kRuler - 4.0 - d}, {x + 3 - d, top + kRuler - 4.0 + d},
                c);
    }
  }
  // A strip a part: what the tracking is worth in each frame.
  int y = top + kRuler + 2;
  for (const BodyPart part : asking_order(s_.near_leg(), false, false)) {
    draw_text(canvas_,
              spoken(part, s_.near_leg()).substr(0, spoken(part, s_.near_leg()).find(" (")),
              {8, y + kStrip - 1}, part == s_.asked_ ? colour::kAccent : colour::kDim, 0.34);
    box(0, count - 1, y, kStrip - 2, colour::kBackground);
    for (const TrajectoryFrame& frame : s_.prediction_.trajectory.frames)
      if (frame[part].present())
        box(frame.frame, frame.frame, y, kStrip - 2, confidence_colour(frame[part].confidence));
    for (const auto& [number, frame] : k.frames)
      if (frame[part])
        box(number, number, y, kStrip - 2,
            frame[part]->state == ClickState::seen        ? colour::kMiddle
            : frame[part]->state == ClickState::estimated ? colour::kDim
                                                          : colour::kBackground);
    y += kStrip;
  }
  draw_ankles({kMargin, y + 3, size.width - kMargin - 12, bottom - y - 3});
  for (const int suspect : s_.prediction_.suspects) {
    const double x = x_of(suspect);
    draw_line(canvas_, {x - 4, y + 4.0}, {x + 4, y + 12.0}, colour::kWrong, 2);
    draw_line(canvas_, {x - 4, y + 12.0}, {x + 4, y + 4.0}, colour::kWrong, 2);
  }
  if (k.trim) {
    const int from = cvRound(x_of(k.trim->first - 0.5)), to = cvRound(x_of(k.trim->last + 0.5));
    shade(canvas_, {kMargin, top, from - kMargin, kTimeline}, 0.45);
    shade(canvas_, {to, top, size.width - 12 - to, kTimeline}, 0.45);
  }
  const int x = cvRound(x_of(s_.frame_));
  cv::line(canvas_, {x, top}, {x, top + kTimeline}, colour::kText);
}

void AnnotationCanvas::draw_ankles(const cv::Rect& lane) {
  cv::rectangle(canvas_, lane, colour::kBackground, cv::FILLED);
  draw_text(canvas_, "ankles x", {8, lane.y + 14}, colour::kDim, 0.34);
  // Against the pelvis, so that the strides of a runner who crosses the picture fill the lane too.
  struct Sample {
    int frame;
    double right, left;
    bool clicked;
  };
  std::vector<Sample> samples;
  double largest = 1;
  const auto add = [&](int frame, const auto& at, bool clicked) {
    const Eigen::Vector2d pelvis = at(BodyPart::pelvis);
    const Eigen::Vector2d right = at(BodyPart::ankle_r), left = at(BodyPart::ankle_l);
    if (!pelvis.allFinite()) return;
    samples.push_back({frame, right.x() - pelvis.x(), left.x() - pelvis.x(), clicked});
    for (const double x : {samples.back().right, samples.back().left})
      if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
  };
  for (const TrajectoryFrame& frame : s_.prediction_.trajectory.frames)
    add(
        frame.frame, [&](BodyPart part) { return frame[part].p_px; }, false);
  for (const auto& [number, frame] : s_.keypoints().frames)
    add(
        number,
        [&](BodyPart part) {
          return frame.placed(part) ? frame[part]->p_px : Eigen::Vector2d::Constant(std::nan(""));
        },
        true);
  const auto at = [&](int frame, double x) {
    return Eigen::Vector2d(x_of(frame),
                           lane.y + lane.height / 2.0 - x / largest * (lane.height / 2.0 - 4));
  };
  const bool right_is_near = s_.near_leg() != "left";
  const auto curve = [&](double Sample::*x, const cv::Scalar& c) {
    const Sample* last = nullptr;
    for (const Sample& sample : samples) {
      if (!std::isfinite(sample.*x)) continue;
      if (sample.clicked) {
        draw_dot(canvas_, at(sample.frame, sample.*x), 2.5, c);
      } else {
        if (last) draw_line(canvas_, at(last->frame, last->*x), at(sample.frame, sample.*x), c);
        last = &sample;
      }
    }
  };
  curve(&Sample::left, right_is_near ? colour::kFar : colour::kNear);
  curve(&Sample::right, right_is_near ? colour::kNear : colour::kFar);
}

void AnnotationCanvas::draw_head_line() {
  const cv::Size size = s_.options_.canvas_px;
  canvas_({0, 0, size.width, kHeadLine}).setTo(colour::kPanel);
  const Keypoints& k = s_.keypoints();
  std::string left = k.video;
  if (!k.direction.empty()) left += fmt::format("   runs to the {}", k.direction);
  if (k.slow_motion != 1) left += fmt::format("   slow motion {}x", k.slow_motion);
  if (k.treadmill.value_or(false)) left += "   treadmill";
  if (k.trim) left += fmt::format("   trim {}-{}", k.trim->first, k.trim->last);
  if (s_.prediction_.stride_frames > 0)
    left += fmt::format("   stride {:.1f} frames", s_.prediction_.stride_frames);
  draw_text(canvas_, left, {10, 17}, colour::kText);

  std::string right = fmt::format("frame {} of {}", s_.frame_, s_.frame_count());
  if (s_.frame_ < s_.frames_.count())
    right += fmt::format("   {:.3f} s", s_.frames_.video_time_s(s_.frame_) / k.slow_motion);
  right += fmt::format("   zoom {:.1f}x   ", s_.view_.scale);
  if (!s_.prediction_.problem.empty()) {
    right += s_.prediction_.problem;
  } else {
    right += s_.prediction_.revision != s_.revision()   ? "tracking ..."
             : s_.prediction_.trajectory.frames.empty() ? "nothing tracked yet"
                                                        : "tracked";
  }
  right += "   ? help";
  draw_text(canvas_, right, {size.width - text_width(right) - 10, 17}, colour::kDim);
}

std::string AnnotationCanvas::what_a_click_does() const {
  using Mode = AnnotationSession::Mode;
  switch (s_.mode_) {
    case Mode::ask_direction:
      return "Which way does the runner run in the picture?  l: to the left   r: to the right";
    case Mode::ask_near_leg:
      return fmt::format(
          "Which of the runner's legs is nearer to the camera?  Enter: the {} one   "
          "l: left   r: right",
          s_.keypoints().direction);
    case Mode::floor_from:
      return "Click one end of a line on the floor along the way of running   Esc: not now";
    case Mode::floor_to:
      return "Click the other end of the floor line   Esc: not now";
    case Mode::type:
      return fmt::format(
          "{}: {}_   Enter: take it   Esc: not now",
          s_.typing_.what == Command::notes ? "Notes" : "Seconds of video for one second",
          s_.typing_.text);
    case Mode::click:
      break;
  }
  if (!s_.asked_)
    return "This frame is complete   Space: next phase frame   drag a point to move it";
  const ClickedFrame* here = s_.clicked(s_.frame_);
  const bool again = here && (*here)[*s_.asked_];
  return fmt::format("Click: {} {}   right click: hidden, estimated   x: absent{}",
                     again ? "again the" : "the", spoken(*s_.asked_, s_.near_leg()),
                     s_.predicted(s_.frame_) ? "   Enter: take the ring" : "");
}

void AnnotationCanvas::draw_status() {
  const cv::Size size = s_.options_.canvas_px;
  const int y = size.height - 10;
  cv::line(canvas_, {0, size.height - kStatus}, {size.width, size.height - kStatus}, colour::kLine);
  int x = 10;
  if (s_.mode_ == AnnotationSession::Mode::click && s_.asked_) {
    draw_dot(canvas_, {x + 5.0, y - 5.0}, 5, colour(*s_.asked_));
    x += 18;
  }
  draw_text(canvas_, what_a_click_does(), {x, y}, colour::kText, 0.5);
  x += text_width(what_a_click_does(), 0.5) + 30;
  std::string message = s_.message_;
  const int room = size.width - x - 10;
  if (text_width(message) > room) {
    // A long message gets a line of its own above the timeline.
    const int top = timeline_top(size);
    shade(canvas_, {0, top - 24, size.width, 24}, 0.3);
    draw_text(canvas_, message, {10, top - 8}, s_.wrong_ ? colour::kWrong : colour::kGood);
    return;
  }
  draw_text(canvas_, message, {size.width - 10 - text_width(message), y},
            s_.wrong_ ? colour::kWrong : colour::kGood);
}

void AnnotationCanvas::draw_help() {
  const auto& help = key_help();
  const int row = 24, width = 760, height = static_cast<int>(help.size()) * row + 34;
  const cv::Size size = s_.options_.canvas_px;
  const cv::Rect box((size.width - width) / 2, std::max(4, (size.height - height) / 2), width,
                     height);
  shade(canvas_, {0, 0, size.width, size.height}, 0.5);
  shade(canvas_, box, 0.25);
  cv::rectangle(canvas_, box, colour::kLine);
  int y = box.y + 30;
  for (const KeyHelp& entry : help) {
    draw_text(canvas_, entry.keys, {box.x + 24, y}, colour::kAccent, 0.5);
    draw_text(canvas_, entry.does, {box.x + 150, y}, colour::kText, 0.47);
    y += row;
  }
}

}  // namespace stride
