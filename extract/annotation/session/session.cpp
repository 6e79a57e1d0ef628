#include "extract/annotation/session/session.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "extract/annotation/asking.h"
#include "extract/annotation/checks.h"
#include "extract/annotation/session/canvas.h"
#include "extract/io/error.h"
#include "extract/skeleton/movement.h"
#include "extract/skeleton/units.h"
#include "extract/tracking/time_check.h"

namespace stride::annotation {
namespace {

constexpr double kGripRadius = 9;       // canvas px around a point
constexpr double kDragThreshold = 3;    // canvas px before a press becomes a drag
constexpr double kUsualStride_s = 0.7;  // of a run, until this runner's is known

}  // namespace

AnnotationSession::AnnotationSession(AnnotationJournal& journal, video::FrameStore& frames,
                                     const AnnotationOptions& options)
    : journal_(journal), frames_(frames), options_(options) {
  view_.image_px = {frames.info().width_px, frames.info().height_px};
  view_.area = AnnotationCanvas::image_area(options.canvas_px);
  view_.fit();
  const Keypoints& k = keypoints();
  if (!movement(k.movement).repeats) options_.head = true;  // it tells how the trunk leans
  if (!k.direction) {
    mode_ = Mode::ask_direction;
  } else if (!k.near_leg) {
    mode_ = Mode::ask_near_leg;
  }
  for (const auto& [number, clicked] : k.frames)
    for (const BodyPart part : kBodyParts)
      if (clicked[part]) {
        options_.hips = options_.hips || part == BodyPart::hip_r || part == BodyPart::hip_l;
        options_.head = options_.head || part == BodyPart::head;
      }
  if (!k.frames.empty()) go_to(k.frames.rbegin()->first);
  ask_first_missing();
  if (k.slow_motion == 1) tell(tracking::doubt_of_header(frames.info()));
  if (journal.recovered() > 0)
    tell(fmt::format("{} edits were recovered that a killed window had left", journal.recovered()));
}

int AnnotationSession::frame_count() const {
  return frames_.complete() ? frames_.count()
                            : std::max(frames_.count(), frames_.info().announced_frames);
}

Side AnnotationSession::near_leg() const { return keypoints().near_leg.value_or(Side::right); }

std::vector<BodyPart> AnnotationSession::order() const {
  return asking_order(near_leg(), options_.hips, options_.head);
}

double AnnotationSession::stride_frames() const {
  if (prediction_.stride_frames > 0) return prediction_.stride_frames;
  const video::VideoInfo& info = frames_.info();
  return kUsualStride_s * std::max(info.rate_hz, 1.0) * keypoints().slow_motion;
}

double AnnotationSession::phase_step() const {
  return std::max(1.0, stride_frames() / kKeyframesPerStride * step_factor_);
}

const cv::Mat& AnnotationSession::shown_image() {
  if (shown_ != frame_) {
    const bool decoded = frame_ < frames_.count();
    shown_image_ = decoded ? frames_.image(frame_) : cv::Mat();
    shown_ = decoded ? frame_ : -1;
  }
  return shown_image_;
}

const cv::Mat& AnnotationSession::shown_area() {
  const bool same = area_frame_ == frame_ && area_view_.scale == view_.scale &&
                    area_view_.p0_px == view_.p0_px && !shown_area_.empty();
  if (!same) {
    shown_area_ = view_.piece_of(shown_image());
    area_view_ = view_;
    area_frame_ = frame_;
  }
  return shown_area_;
}

const ClickedFrame* AnnotationSession::clicked(int frame) const {
  const auto found = keypoints().frames.find(frame);
  return found == keypoints().frames.end() ? nullptr : &found->second;
}

const TrajectoryFrame* AnnotationSession::predicted(int frame) const {
  const auto& frames = prediction_.trajectory.frames;
  if (frames.empty()) return nullptr;
  const int i = frame - frames.front().frame;
  if (i < 0 || i >= static_cast<int>(frames.size())) return nullptr;
  return &frames[static_cast<std::size_t>(i)];
}

void AnnotationSession::tell(std::string message, bool wrong) {
  message_ = std::move(message);
  wrong_ = wrong;
}

void AnnotationSession::handle(const AnnotationEvent& event) {
  const bool toggles = event.kind == AnnotationEvent::Kind::key && event.key == key::kTab;
  if (event.kind != AnnotationEvent::Kind::move && !toggles) playing_ = false;
  try {
    switch (event.kind) {
      case AnnotationEvent::Kind::press:
        return press(event);
      case AnnotationEvent::Kind::release:
        return release(event);
      case AnnotationEvent::Kind::move:
        return move(event);
      case AnnotationEvent::Kind::wheel:
        if (view_.contains(event.p_canvas))
          view_.zoom(view_.scale * (event.wheel > 0 ? 1.25 : 0.8), event.p_canvas);
        return;
      case AnnotationEvent::Kind::key:
        return press_key(event.key);
    }
  } catch (const Error& error) {
    tell(error.what(), true);
  }
}

void AnnotationSession::set_prediction(Prediction prediction) {
  // The user's factor applied to the guess, not to the measured stride.
  if (prediction_.stride_frames == 0 && prediction.stride_frames > 0) step_factor_ = 1;
  const bool first = prediction_.trajectory.frames.empty();
  prediction_ = std::move(prediction);
  passed_by_.clear();
  if (options_.corrects && first && mode_ == Mode::click) go_to_worst();
}

void AnnotationSession::resize(cv::Size canvas_px) {
  constexpr int kLeastWidth = 800, kLeastHeight = 500;
  canvas_px = {std::max(canvas_px.width, kLeastWidth), std::max(canvas_px.height, kLeastHeight)};
  if (canvas_px == options_.canvas_px) return;
  options_.canvas_px = canvas_px;
  const double magnified = view_.scale / view_.fitting_scale();
  const Eigen::Vector2d middle = view_.to_image(
      {view_.area.x + view_.area.width / 2.0, view_.area.y + view_.area.height / 2.0});
  view_.area = AnnotationCanvas::image_area(canvas_px);
  view_.fit();
  if (magnified > 1) view_.zoom(magnified * view_.scale, view_.to_canvas(middle));
  area_frame_ = -1;
}

void AnnotationSession::show_next() {
  const auto& trim = keypoints().trim;
  const int first = trim ? trim->first : 0,
            last = std::min(trim ? trim->last : frames_.count() - 1, frames_.count() - 1);
  go_to(frame_ >= last || frame_ < first ? first : frame_ + 1);
}

double AnnotationSession::frame_s() const { return 1 / std::max(frames_.info().rate_hz, 1.0); }

bool AnnotationSession::rest() {
  if (journal_.is_folded()) return false;
  try {
    journal_.fold();
  } catch (const Error& error) {
    tell(error.what(), true);
  }
  return true;
}

cv::Mat AnnotationSession::picture() { return AnnotationCanvas(*this).draw(); }

void AnnotationSession::press(const AnnotationEvent& event) {
  mouse_ = event.p_canvas;
  help_ = false;
  if (event.button == AnnotationEvent::Button::middle) {
    grip_ = {Grip::What::pan, BodyPart::pelvis, event.p_canvas, false, ClickState::seen};
    return;
  }
  if (const auto frame =
          AnnotationCanvas::frame_at(event.p_canvas, options_.canvas_px, frame_count())) {
    grip_ = {Grip::What::timeline, BodyPart::pelvis, event.p_canvas, false, ClickState::seen};
    return go_to(*frame);
  }
  if (!view_.contains(event.p_canvas)) return;
  const Eigen::Vector2d p_px = view_.inside(view_.to_image(event.p_canvas));
  const ClickState state =
      event.button == AnnotationEvent::Button::right ? ClickState::estimated : ClickState::seen;
  switch (mode_) {
    case Mode::floor_from:
    case Mode::floor_to:
      return mark_floor(p_px);
    case Mode::length_from:
    case Mode::length_to:
      return mark_length(p_px);
    case Mode::click:
      break;
    default:
      return tell("answer the question by a key first", true);
  }
  auto part = click_at(event.p_canvas);
  if (!part && options_.corrects) part = predicted_at(event.p_canvas);
  if (part) {
    grip_ = {Grip::What::point, *part, event.p_canvas, false, state};
  } else {
    place_asked(event.p_canvas, state);
  }
}

void AnnotationSession::move(const AnnotationEvent& event) {
  const Eigen::Vector2d by = event.p_canvas - mouse_;
  mouse_ = event.p_canvas;
  if ((event.p_canvas - grip_.from_canvas).norm() > kDragThreshold) grip_.moved = true;
  if (grip_.what == Grip::What::pan) view_.pan(by);
  if (grip_.what == Grip::What::timeline)
    if (const auto frame = AnnotationCanvas::frame_at({event.p_canvas.x(), grip_.from_canvas.y()},
                                                      options_.canvas_px, frame_count()))
      go_to(*frame);
}

void AnnotationSession::release(const AnnotationEvent& event) {
  mouse_ = event.p_canvas;
  const Grip grip = std::exchange(grip_, {});
  if (grip.what != Grip::What::point) return;
  if (!grip.moved && (event.p_canvas - grip.from_canvas).norm() <= kDragThreshold) {
    if (asked_ && !options_.corrects && is_double_click(grip))
      return tell(
          fmt::format("a double click? {} is there already; click again to put {} there too",
                      spoken(grip.part, near_leg()), spoken(*asked_, near_leg())),
          true);
    if (asked_) return place_asked(event.p_canvas, grip.state);
    last_ = grip.part;
    if (options_.corrects) asked_ = grip.part;
    return;
  }
  // The point keeps its offset from the mouse, so that grabbing does not move it.
  const Eigen::Vector2d by_px = (event.p_canvas - grip.from_canvas) / view_.scale;
  const ClickedFrame* here = clicked(frame_);
  if (!here || !here->placed(grip.part)) {
    const TrajectoryFrame* ghost = options_.corrects ? predicted(frame_) : nullptr;
    if (!ghost || !(*ghost)[grip.part].present()) return;
    place(grip.part, view_.inside((*ghost)[grip.part].p_px + by_px), grip.state);
    return advance(grip.part);
  }
  place(grip.part, view_.inside((*here)[grip.part]->p_px + by_px), (*here)[grip.part]->state);
}

bool AnnotationSession::is_double_click(const Grip& grip) {
  const bool on_the_last = grip.state == ClickState::seen && grip.part == last_;
  if (!on_the_last || doubled_ == asked_) {
    doubled_.reset();
    return false;
  }
  doubled_ = asked_;
  return true;
}

std::optional<BodyPart> AnnotationSession::click_at(const Eigen::Vector2d& canvas) const {
  const ClickedFrame* here = clicked(frame_);
  std::optional<BodyPart> nearest;
  double least = kGripRadius;
  for (const BodyPart part : kBodyParts) {
    if (!here || !here->placed(part)) continue;
    const double distance = (view_.to_canvas((*here)[part]->p_px) - canvas).norm();
    if (distance < least) {
      least = distance;
      nearest = part;
    }
  }
  return nearest;
}

std::optional<BodyPart> AnnotationSession::predicted_at(const Eigen::Vector2d& canvas) const {
  const TrajectoryFrame* here = predicted(frame_);
  const ClickedFrame* clicks = clicked(frame_);
  std::optional<BodyPart> nearest;
  double least = kGripRadius;
  for (const BodyPart part : order()) {
    if (!here || !(*here)[part].present() || (clicks && (*clicks)[part])) continue;
    const double distance = (view_.to_canvas((*here)[part].p_px) - canvas).norm();
    if (distance < least) {
      least = distance;
      nearest = part;
    }
  }
  return nearest;
}

void AnnotationSession::place_asked(const Eigen::Vector2d& canvas, ClickState state) {
  if (!asked_)
    return tell(options_.corrects ? "drag the point that is wrong, or n: the worst one"
                                  : "every part of this frame is clicked; choose one by its digit",
                true);
  const BodyPart part = *asked_;
  place(part, view_.inside(view_.to_image(canvas)), state);
  advance(part);
}

void AnnotationSession::mark_floor(const Eigen::Vector2d& p_px) {
  if (mode_ == Mode::floor_from) {
    floor_from_ = p_px;
    mode_ = Mode::floor_to;
    return;
  }
  mode_ = Mode::click;
  ClipSettings settings = settings_of(keypoints());
  settings.floor = FloorLine{floor_from_, p_px};
  edit_settings("floor line", settings);
}

std::optional<Eigen::Vector2d> AnnotationSession::pelvis_px(int frame) const {
  const ClickedFrame* here = clicked(frame);
  if (here && here->placed(BodyPart::pelvis)) return (*here)[BodyPart::pelvis]->p_px;
  const TrajectoryFrame* tracked = predicted(frame);
  if (tracked && (*tracked)[BodyPart::pelvis].present()) return (*tracked)[BodyPart::pelvis].p_px;
  // After the last click the runner continues at the same speed.
  const auto& frames = keypoints().frames;
  const auto last = frames.rbegin(), before = frames.size() < 2 ? frames.rend() : std::next(last);
  if (before == frames.rend() || frame < last->first || !last->second.placed(BodyPart::pelvis) ||
      !before->second.placed(BodyPart::pelvis))
    return std::nullopt;
  const Eigen::Vector2d p = last->second[BodyPart::pelvis]->p_px;
  return p + (p - before->second[BodyPart::pelvis]->p_px) * (frame - last->first) /
                 (last->first - before->first);
}

void AnnotationSession::go_to(int frame) {
  frame = std::clamp(frame, 0, std::max(frame_count() - 1, 0));
  if (frame == frame_) return;
  // A zoomed view follows the runner.
  const auto before = pelvis_px(frame_), after = pelvis_px(frame);
  if (before && after) view_.pan(view_.scale * (*before - *after));
  frame_ = frame;
  tell("");
  ask_first_missing();
}

}  // namespace stride::annotation
