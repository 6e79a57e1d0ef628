// The timeline of the window: ruler, a strip for each part, the ankles.
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "extract/annotation/asking.h"
#include "extract/annotation/session/canvas.h"
#include "extract/annotation/session/draw.h"

namespace stride::annotation {
namespace {

constexpr int kMargin = 96, kRight = 12, kRuler = 18, kStrip = 12;

}  // namespace

std::optional<int> AnnotationCanvas::frame_at(const Eigen::Vector2d& p, cv::Size canvas,
                                              int frame_count) {
  const int top = timeline_top(canvas);
  if (p.y() < top || p.y() >= top + kTimeline || frame_count < 1) return std::nullopt;
  const double width = canvas.width - kMargin - kRight;
  const double frame = std::floor((p.x() - kMargin) / width * frame_count);
  if (frame < -1 || frame > frame_count) return std::nullopt;
  return std::clamp(static_cast<int>(frame), 0, frame_count - 1);
}

double AnnotationCanvas::x_of(double frame) const {
  return kMargin + (frame + 0.5) / std::max(s_.frame_count(), 1) *
                       (s_.options_.canvas_px.width - kMargin - kRight);
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
  // A strip for each part: clicks and the confidence of tracking.
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
  draw_ankles({kMargin, y + 3, size.width - kMargin - kRight, bottom - y - 3});
  for (const int suspect : s_.prediction_.suspects) {
    const double x = x_of(suspect);
    draw_line(canvas_, {x - 4, y + 4.0}, {x + 4, y + 12.0}, colour::kWrong, 2);
    draw_line(canvas_, {x - 4, y + 12.0}, {x + 4, y + 4.0}, colour::kWrong, 2);
  }
  if (k.trim) {
    const int from = cvRound(x_of(k.trim->first - 0.5)), to = cvRound(x_of(k.trim->last + 0.5));
    shade(canvas_, {kMargin, top, from - kMargin, kTimeline}, 0.45);
    shade(canvas_, {to, top, size.width - kRight - to, kTimeline}, 0.45);
  }
  const int x = cvRound(x_of(s_.frame_));
  cv::line(canvas_, {x, top}, {x, top + kTimeline}, colour::kText);
}

void AnnotationCanvas::draw_ankles(const cv::Rect& lane) {
  cv::rectangle(canvas_, lane, colour::kBackground, cv::FILLED);
  draw_text(canvas_, "ankles x", {8, lane.y + 14}, colour::kDim, 0.34);
  // Relative to the pelvis, so that a runner who crosses the picture fills the lane too.
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
        [&frame = frame](BodyPart part) {
          return frame.placed(part) ? frame[part]->p_px : Eigen::Vector2d::Constant(std::nan(""));
        },
        true);
  const auto at = [&](int frame, double x) {
    return Eigen::Vector2d(x_of(frame),
                           lane.y + lane.height / 2.0 - x / largest * (lane.height / 2.0 - 4));
  };
  const bool right_is_near = s_.near_leg() == Side::right;
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

}  // namespace stride::annotation
