// Text of the window: what is shown, what a click will do, help.
#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "extract/annotation/asking.h"
#include "extract/annotation/session/canvas.h"
#include "extract/annotation/session/draw.h"

namespace stride::annotation {

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
  const std::string& message = s_.message_;
  if (message.empty()) return;
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
  const cv::Size size = s_.options_.canvas_px;
  const int rows = static_cast<int>(help.size());
  const int row = std::min(24, (size.height - 40) / rows), width = 760, height = rows * row + 34;
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

}  // namespace stride::annotation
