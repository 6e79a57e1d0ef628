// Text of the window: what is shown, what a click will do, help.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "extract/annotation/asking.h"
#include "extract/annotation/session/canvas.h"
#include "extract/annotation/session/draw.h"
#include "extract/skeleton/movement.h"

namespace stride::annotation {

namespace {

/// How far the clicks reach.
std::string clicked_strides(const Keypoints& k, double stride_frames) {
  if (k.frames.size() < 2) return {};
  const double strides = (k.frames.rbegin()->first - k.frames.begin()->first) / stride_frames;
  return strides < 1 ? fmt::format(", {:.2f} of 1 clicked", strides)
                     : fmt::format(", {:.1f} clicked", strides);
}

/// A runner whose joints are clicked: places in units of the box, right leg first.
void draw_landmarks(cv::Mat& canvas, const cv::Rect& box) {
  struct Landmark {
    double x, y;
  };
  static const std::vector<Landmark> near{{0.45, 0.28}, {0.55, 0.44}, {0.56, 0.635}, {0.68, 0.655}},
      far{{0.45, 0.28}, {0.35, 0.44}, {0.175, 0.46}, {0.14, 0.52}};
  static const std::vector<const char*> where{"Joint centres:",
                                              "pelvis: midway between the hip",
                                              "   joints, a hand below the belt",
                                              "knee: where thigh and shank meet",
                                              "ankle: the bump above the shoe",
                                              "toe: the tip of the shoe",
                                              "Thigh and shank are equally long."};
  const auto at = [&](double x, double y) {
    return cv::Point(box.x + static_cast<int>(x * box.width),
                     box.y + static_cast<int>(y * box.height));
  };
  cv::line(canvas, at(0.45, 0.28), at(0.49, 0.11), colour::kDim, 3, cv::LINE_AA);
  cv::circle(canvas, at(0.505, 0.065), box.height / 30, colour::kDim, 2, cv::LINE_AA);
  for (const auto& [leg, paint] :
       {std::pair(&far, colour::kFar), std::pair(&near, colour::kNear)}) {
    for (std::size_t i = 1; i < leg->size(); ++i)
      cv::line(canvas, at((*leg)[i - 1].x, (*leg)[i - 1].y), at((*leg)[i].x, (*leg)[i].y), paint, 3,
               cv::LINE_AA);
    for (const Landmark& mark : *leg)
      cv::circle(canvas, at(mark.x, mark.y), 5, paint, cv::FILLED, cv::LINE_AA);
  }
  double y = 0.70;
  for (const char* line : where) {
    draw_text(canvas, line, at(0.04, y), y == 0.70 ? colour::kAccent : colour::kText, 0.45);
    y += 0.045;
  }
}

}  // namespace

void AnnotationCanvas::draw_head_line() {
  const cv::Size size = s_.options_.canvas_px;
  canvas_({0, 0, size.width, kHeadLine}).setTo(colour::kPanel);
  const Keypoints& k = s_.keypoints();
  std::string left = k.video;
  if (k.movement != Keypoints().movement) left += "   " + k.movement;
  if (k.direction) left += fmt::format("   runs to the {}", kFacings[*k.direction]);
  if (k.slow_motion != 1) left += fmt::format("   slow motion {}x", k.slow_motion);
  if (k.treadmill.value_or(false)) left += "   treadmill";
  if (k.calibration_line)
    left += fmt::format("   {:.3g} mm/px", 1000 * k.calibration_line->metres_per_pixel());
  if (k.trim) left += fmt::format("   trim {}-{}", k.trim->first, k.trim->last);
  if (s_.prediction_.stride_frames > 0)
    left += fmt::format("   stride {:.1f} frames{}", s_.prediction_.stride_frames,
                        clicked_strides(k, s_.prediction_.stride_frames));
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
  const int at = size.width - text_width(right) - 10;
  cv::rectangle(canvas_, {at - 10, 0, size.width, kHeadLine}, colour::kPanel, cv::FILLED);
  draw_text(canvas_, right, {at, 17}, colour::kDim);
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
          name_or_empty(kFacings, s_.keypoints().direction));
    case Mode::floor_from:
      return "Click one end of a line on the floor along the way of running   Esc: not now";
    case Mode::floor_to:
      return "Click the other end of the floor line   Esc: not now";
    case Mode::length_from:
      return "Click one end of a length that you know, where the runner runs: marks on the floor, "
             "a "
             "person who stands   Backspace: no line   Esc: not now";
    case Mode::length_to:
      return "Click its other end   Esc: not now";
    case Mode::type:
      return fmt::format("{}: {}_   Enter: take it   Esc: not now",
                         s_.typing_.what == Command::notes ? "Notes"
                         : s_.typing_.what == Command::calibration_line
                             ? "Length of the line in metres"
                             : "Seconds of video for one second",
                         s_.typing_.text);
    case Mode::click:
      break;
  }
  if (!s_.asked_ && s_.options_.corrects)
    return "Drag a point to where it belongs   n: the least certain one   Space: next phase frame";
  const std::vector<std::string>& moments = movement(s_.keypoints().movement).moments;
  if (!s_.asked_ && !moments.empty())
    return fmt::format("This frame is complete   Space: next frame to click; and those of {}",
                       fmt::join(moments, ", "));
  if (!s_.asked_)
    return "This frame is complete   Space: next phase frame   drag a point to move it";
  const ClickedFrame* here = s_.clicked(s_.frame_);
  const bool again = here && (*here)[*s_.asked_];
  const bool middle = *s_.asked_ == BodyPart::pelvis;
  return fmt::format("Click: {} {}{}   right click: hidden, estimated   x: absent{}",
                     again ? "again the" : "the", spoken(*s_.asked_, s_.near_leg()),
                     middle ? " (midway between the hips)" : "",
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
  const std::string click = what_a_click_does();
  const double letters = std::min(0.5, 0.5 * (size.width - x - 10) / text_width(click, 0.5));
  draw_text(canvas_, click, {x, y}, colour::kText, letters);
  x += text_width(click, letters) + 30;
  const bool in_doubt = s_.message_.empty();
  const std::string& message = in_doubt ? s_.prediction_.doubt : s_.message_;
  if (message.empty()) return;
  const cv::Scalar& paint = s_.wrong_ || in_doubt ? colour::kWrong : colour::kGood;
  const int room = size.width - x - 10;
  if (text_width(message) > room) {
    // A long message gets a line of its own above the timeline.
    const int top = timeline_top(size);
    shade(canvas_, {0, top - 24, size.width, 24}, 0.3);
    draw_text(canvas_, message, {10, top - 8}, paint);
    return;
  }
  draw_text(canvas_, message, {size.width - 10 - text_width(message), y}, paint);
}

void AnnotationCanvas::draw_help() {
  const auto& help = key_help();
  const cv::Size size = s_.options_.canvas_px;
  const int rows = static_cast<int>(help.size());
  const int row = std::min(24, (size.height - 40) / rows), width = 760, height = rows * row + 34;
  constexpr int kLandmarks = 460, kGap = 10;
  const bool landmarks = size.width >= width + kLandmarks + 3 * kGap;
  const cv::Rect box(landmarks ? kGap : (size.width - width) / 2,
                     std::max(4, (size.height - height) / 2), width, height);
  shade(canvas_, {0, 0, size.width, size.height}, 0.5);
  shade(canvas_, box, 0.25);
  cv::rectangle(canvas_, box, colour::kLine);
  int y = box.y + 30;
  for (const KeyHelp& entry : help) {
    draw_text(canvas_, entry.keys, {box.x + 24, y}, colour::kAccent, 0.5);
    draw_text(canvas_, entry.does, {box.x + 150, y}, colour::kText, 0.47);
    y += row;
  }
  if (!landmarks) return;
  const cv::Rect figure(box.x + width + kGap, box.y, size.width - width - 3 * kGap,
                        std::min(420, height));
  shade(canvas_, figure, 0.25);
  cv::rectangle(canvas_, figure, colour::kLine);
  draw_landmarks(canvas_, figure);
}

}  // namespace stride::annotation
