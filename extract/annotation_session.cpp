#include "extract/annotation_session.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "extract/annotation/asking.h"
#include "extract/annotation/canvas.h"
#include "extract/annotation/checks.h"
#include "extract/error.h"

namespace stride {
namespace {

constexpr double kGripRadius = 9;       // canvas px around a point
constexpr double kDragThreshold = 3;    // canvas px before a press becomes a drag
constexpr double kNudge = 0.25;         // px
constexpr double kCloseUp = 8;          // canvas px an image px
constexpr int kPhasesPerStride = 8;     // four a half step, as in the paper
constexpr double kUsualStride_s = 0.7;  // of a run, until this one's is known

Eigen::Vector2d inside(const Eigen::Vector2d& p_px, const VideoInfo& info) {
  return {std::clamp(p_px.x(), -0.5, info.width_px - 0.5),
          std::clamp(p_px.y(), -0.5, info.height_px - 0.5)};
}

}  // namespace

AnnotationSession::AnnotationSession(AnnotationJournal& journal, FrameStore& frames,
                                     const AnnotationOptions& options)
    : journal_(journal), frames_(frames), options_(options) {
  view_.image_px = {frames.info().width_px, frames.info().height_px};
  view_.area = AnnotationCanvas::image_area(options.canvas_px);
  view_.fit();
  const Keypoints& k = keypoints();
  if (k.direction.empty()) {
    mode_ = Mode::ask_direction;
  } else if (k.near_leg.empty()) {
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
  if (journal.recovered() > 0)
    tell(fmt::format("{} edits were recovered that a killed window had left", journal.recovered()));
}

int AnnotationSession::frame_count() const {
  return frames_.complete() ? frames_.count()
                            : std::max(frames_.count(), frames_.info().announced_frames);
}

std::string AnnotationSession::near_leg() const {
  return keypoints().near_leg.empty() ? "right" : keypoints().near_leg;
}

std::vector<BodyPart> AnnotationSession::order() const {
  return asking_order(near_leg(), options_.hips, options_.head);
}

double AnnotationSession::stride_frames() const {
  if (prediction_.stride_frames > 0) return prediction_.stride_frames;
  const VideoInfo& info = frames_.info();
  return kUsualStride_s * std::max(info.rate_hz, 1.0) * keypoints().slow_motion;
}

double AnnotationSession::phase_step() const {
  return std::max(1.0, stride_frames() / kPhasesPerStride * step_factor_);
}

const cv::Mat& AnnotationSession::shown_image() {
  if (shown_ != frame_) {
    const bool decoded = frame_ < frames_.count();
    shown_image_ = decoded ? frames_.image(frame_) : cv::Mat();
    shown_ = decoded ? frame_ : -1;
  }
  return shown_image_;
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
  // What the user made of the guess does not hold for the stride itself.
  if (prediction_.stride_frames == 0 && prediction.stride_frames > 0) step_factor_ = 1;
  prediction_ = std::move(prediction);
  passed_by_.clear();
}

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

// Mouse.

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
  const Eigen::Vector2d p_px = inside(view_.to_image(event.p_canvas), frames_.info());
  const ClickState state =
      event.button == AnnotationEvent::Button::right ? ClickState::estimated : ClickState::seen;
  switch (mode_) {
    case Mode::floor_from:
    case Mode::floor_to:
      return mark_floor(p_px);
    case Mode::click:
      break;
    default:
      return tell("answer the question by a key first", true);
  }
  if (const auto part = click_at(event.p_canvas)) {
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
    if (asked_) return place_asked(event.p_canvas, grip.state);
    last_ = grip.part;
    return;
  }
  const ClickedFrame* here = clicked(frame_);
  if (!here || !here->placed(grip.part)) return;
  // The point keeps its distance from the mouse, so that gripping it does not move it.
  const Eigen::Vector2d by_px = (event.p_canvas - grip.from_canvas) / view_.scale;
  place(grip.part, inside((*here)[grip.part]->p_px + by_px, frames_.info()),
        (*here)[grip.part]->state);
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

void AnnotationSession::place_asked(const Eigen::Vector2d& canvas, ClickState state) {
  if (!asked_) return tell("every part of this frame is clicked; choose one by its digit", true);
  const BodyPart part = *asked_;
  place(part, inside(view_.to_image(canvas), frames_.info()), state);
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

// Edits.

void AnnotationSession::edit(Change change) {
  const std::string what = change.what;
  journal_.apply(std::move(change));
  tell(what);
}

void AnnotationSession::edit_settings(const std::string& what, const ClipSettings& settings) {
  edit({what, {}, settings});
}

void AnnotationSession::place(BodyPart part, const Eigen::Vector2d& p_px, ClickState state) {
  require(frame_ < frames_.count(), "frame {} is still being decoded; wait a moment", frame_);
  edit({fmt::format("{} on frame {}{}", spoken(part, near_leg()), frame_,
                    state == ClickState::seen ? "" : fmt::format(": {}", name(state))),
        {{frame_, frames_.video_time_s(frame_), part, Click{p_px, state, ""}}},
        {}});
  last_ = part;
}

void AnnotationSession::advance(BodyPart after) {
  asked_ = next_missing(keypoints(), frame_, order(), after);
  if (asked_) return;
  const int next = next_phase_frame(keypoints(), frame_, phase_step());
  const std::string complete = fmt::format("frame {} is complete", frame_);
  if (next >= frame_count()) return tell(complete + "; the clip ends before the next phase frame");
  go_to(next);
  tell(complete);
}

void AnnotationSession::ask_first_missing() {
  asked_ = next_missing(keypoints(), frame_, order(), std::nullopt);
  last_.reset();
}

void AnnotationSession::nudge(const Eigen::Vector2d& move_px) {
  const ClickedFrame* here = clicked(frame_);
  if (!last_ || !here || !here->placed(*last_))
    return tell("no point to move: click one, or choose it by its digit", true);
  place(*last_, inside((*here)[*last_]->p_px + move_px, frames_.info()), (*here)[*last_]->state);
}

void AnnotationSession::swap_legs() {
  const int from = range_from_ ? std::min(*range_from_, frame_) : frame_;
  const int to = range_from_ ? std::max(*range_from_, frame_) : frame_;
  Change change{from == to ? fmt::format("legs swapped on frame {}", from)
                           : fmt::format("legs swapped on frames {} to {}", from, to),
                {},
                {}};
  for (auto frame = keypoints().frames.lower_bound(from);
       frame != keypoints().frames.end() && frame->first <= to; ++frame)
    for (const BodyPart part : kBodyParts)
      if (mirrored(part) != part && (frame->second[part] || frame->second[mirrored(part)]))
        change.clicks.push_back({frame->first, frame->second.time_s * keypoints().slow_motion, part,
                                 frame->second[mirrored(part)]});
  if (change.clicks.empty()) return tell("no clicked leg here to swap", true);
  range_from_.reset();
  edit(std::move(change));
}

void AnnotationSession::copy_from_neighbour() {
  require(frame_ < frames_.count(), "frame {} is still being decoded; wait a moment", frame_);
  const ClickedFrame* nearest = nullptr;
  int distance = 0, number = 0;
  for (const auto& [other, frame] : keypoints().frames)
    if (other != frame_ && (!nearest || std::abs(other - frame_) < distance)) {
      nearest = &frame;
      number = other;
      distance = std::abs(other - frame_);
    }
  if (!nearest) return tell("no other frame is clicked yet", true);
  const ClickedFrame* here = clicked(frame_);
  Change change{
      fmt::format("copied from frame {}: drag the points to their places", number), {}, {}};
  for (const BodyPart part : kBodyParts)
    if (nearest->placed(part) && !(here && (*here)[part]))
      change.clicks.push_back({frame_, frames_.video_time_s(frame_), part, (*nearest)[part]});
  if (change.clicks.empty()) return tell("nothing is missing here", true);
  edit(std::move(change));
  ask_first_missing();
}

void AnnotationSession::erase() {
  const ClickedFrame* here = clicked(frame_);
  const std::optional<BodyPart> part = last_ ? last_ : asked_;
  if (!part || !here || !(*here)[*part])
    return tell("no click to take away: choose a part by its digit", true);
  edit({fmt::format("{} on frame {} taken away", spoken(*part, near_leg()), frame_),
        {{frame_, frames_.video_time_s(frame_), *part, std::nullopt}},
        {}});
  asked_ = part;
}

void AnnotationSession::set_trim() {
  ClipSettings settings = settings_of(keypoints());
  if (!range_from_) {
    if (!settings.trim) return tell("begin a range with b, go to its end, then trim with t", true);
    settings.trim.reset();
    return edit_settings("trim taken away: the whole clip is used", settings);
  }
  settings.trim = FrameRange{std::min(*range_from_, frame_), std::max(*range_from_, frame_)};
  range_from_.reset();
  edit_settings(
      fmt::format("trimmed to frames {} to {}", settings.trim->first, settings.trim->last),
      settings);
}

// Keys.

void AnnotationSession::press_key(int key) {
  if (key == key::kShift || key == key::kAlt) return;
  if (key == '\n') key = key::kEnter;
  if (mode_ == Mode::type) return type(key);
  const Command what = command_of(key);
  if (help_ || what == Command::help) {
    help_ = !help_ && what == Command::help;
    return;
  }
  if (what == Command::quit) {
    rest();
    done_ = true;
    return;
  }
  if (mode_ == Mode::ask_direction || mode_ == Mode::ask_near_leg) return answer(key);
  if (what != Command::none) command(what, key);
}

void AnnotationSession::answer(int key) {
  ClipSettings settings = settings_of(keypoints());
  const bool right = key == 'r' || key == key::kRight, left = key == 'l' || key == key::kLeft;
  if (mode_ == Mode::ask_direction) {
    if (!right && !left) return;
    settings.direction = right ? "right" : "left";
    // Whoever runs to the right shows the camera the right side.
    mode_ = Mode::ask_near_leg;
    return edit_settings(fmt::format("runs to the {}", settings.direction), settings);
  }
  if (!right && !left && key != key::kEnter) return;
  settings.near_leg = key == key::kEnter ? settings.direction : right ? "right" : "left";
  mode_ = Mode::click;
  edit_settings(fmt::format("the {} leg is near", settings.near_leg), settings);
  ask_first_missing();
}

void AnnotationSession::type(int key) {
  if (key == key::kEscape) {
    mode_ = Mode::click;
  } else if (key == key::kEnter) {
    finish_typing();
  } else if (key == key::kBackspace) {
    if (!typing_.text.empty()) typing_.text.pop_back();
  } else if (key >= ' ' && key < 127) {
    typing_.text += static_cast<char>(key);
  }
}

void AnnotationSession::finish_typing() {
  mode_ = Mode::click;
  ClipSettings settings = settings_of(keypoints());
  if (typing_.what == Command::notes) {
    settings.notes = typing_.text;
    return edit_settings("notes", settings);
  }
  double factor = 0;
  const char* end = typing_.text.data() + typing_.text.size();
  const auto parsed = std::from_chars(typing_.text.data(), end, factor);
  require(parsed.ec == std::errc() && parsed.ptr == end && factor > 0 && factor <= 1000,
          "slow motion = '{}': must be how many seconds of video show one second, as 4 or 2.5",
          typing_.text);
  settings.slow_motion = factor;
  edit_settings(fmt::format("slow motion {}", factor), settings);
}

void AnnotationSession::command(Command command, int key) {
  ClipSettings settings = settings_of(keypoints());
  switch (command) {
    case Command::choose_part: {
      const auto all = asking_order(near_leg(), true, true);
      // 1 … 7 as asked without hips; 8, 9, 0 the hips and the head.
      constexpr std::array<int, 10> kPlace{9, 0, 1, 2, 3, 5, 6, 7, 4, 8};
      last_ = asked_ = all[static_cast<std::size_t>(kPlace[static_cast<std::size_t>(key - '0')])];
      return;
    }
    case Command::absent:
      if (!asked_)
        return tell("every part of this frame is clicked; choose one by its digit", true);
      {
        const BodyPart part = *asked_;
        place(part, Eigen::Vector2d::Zero(), ClickState::absent);
        return advance(part);
      }
    case Command::accept: {
      const TrajectoryFrame* ghost = predicted(frame_);
      if (!asked_ || !ghost || !(*ghost)[*asked_].present())
        return tell("no prediction of this part here yet", true);
      const BodyPart part = *asked_;
      place(part, inside((*ghost)[part].p_px, frames_.info()), ClickState::seen);
      return advance(part);
    }
    case Command::erase:
      return erase();
    case Command::copy:
      return copy_from_neighbour();
    case Command::nudge_up:
      return nudge({0, -kNudge});
    case Command::nudge_down:
      return nudge({0, kNudge});
    case Command::nudge_left:
      return nudge({-kNudge, 0});
    case Command::nudge_right:
      return nudge({kNudge, 0});
    case Command::swap_legs:
      return swap_legs();
    case Command::begin_range:
      range_from_ = frame_;
      return tell(fmt::format("a range begins at frame {}; go to its end", frame_));
    case Command::trim:
      return set_trim();
    case Command::undo:
    case Command::redo: {
      const auto change = command == Command::undo ? journal_.undo() : journal_.redo();
      const char* word = command == Command::undo ? "undone" : "redone";
      if (!change) return tell(fmt::format("nothing to be {}", word), true);
      if (!change->clicks.empty()) go_to(change->clicks.front().frame);
      ask_first_missing();
      if (change->clicks.size() == 1) last_ = change->clicks.front().part;
      if (change->clicks.size() == 1 && !change->clicks.front().click) asked_ = last_;
      return tell(fmt::format("{}: {}", word, change->what));
    }
    case Command::zoom:
      if (view_.scale > view_.fitting_scale() * 1.001) return view_.fit();
      return view_.zoom(kCloseUp, view_.contains(mouse_)
                                      ? mouse_
                                      : Eigen::Vector2d(view_.area.width, view_.area.height) / 2);
    case Command::toggle_hips:
      options_.hips = !options_.hips;
      ask_first_missing();
      return tell(options_.hips ? "hips are asked for" : "hips are not asked for");
    case Command::toggle_head:
      options_.head = !options_.head;
      ask_first_missing();
      return tell(options_.head ? "the head is asked for" : "the head is not asked for");
    case Command::finer_phases:
    case Command::coarser_phases:
      step_factor_ *= command == Command::finer_phases ? 0.8 : 1.25;
      return tell(fmt::format("phase frames are {:.1f} frames apart", phase_step()));
    case Command::floor_line:
      mode_ = Mode::floor_from;
      return;
    case Command::floor_from_feet:
      settings.floor = stride::floor_from_feet(prediction_.trajectory, stride_frames());
      if (!settings.floor)
        return tell("the feet stand at one place of the picture: mark the floor with o", true);
      return edit_settings("floor line from the standing feet", settings);
    case Command::slow_motion:
    case Command::notes:
      mode_ = Mode::type;
      typing_ = {command, command == Command::notes ? settings.notes : ""};
      return;
    case Command::treadmill:
      settings.treadmill = !settings.treadmill.value_or(false);
      return edit_settings(*settings.treadmill ? "on a treadmill" : "not on a treadmill", settings);
    case Command::ask_again:
      mode_ = Mode::ask_direction;
      return;
    case Command::cancel:
      range_from_.reset();
      mode_ = Mode::click;
      view_.fit();
      return tell("");
    case Command::save:
      journal_.fold();
      return tell("written");
    default:
      return step(command);
  }
}

void AnnotationSession::step(Command command) {
  const auto& clicked_frames = keypoints().frames;
  switch (command) {
    case Command::previous_frame:
      return go_to(frame_ - 1);
    case Command::next_frame:
      return go_to(frame_ + 1);
    case Command::first_frame:
      return go_to(0);
    case Command::last_frame:
      return go_to(frame_count() - 1);
    case Command::previous_clicked: {
      const auto here = clicked_frames.lower_bound(frame_);
      return here == clicked_frames.begin() ? tell("no clicked frame before this one", true)
                                            : go_to(std::prev(here)->first);
    }
    case Command::next_clicked: {
      const auto next = clicked_frames.upper_bound(frame_);
      return next == clicked_frames.end() ? tell("no clicked frame after this one", true)
                                          : go_to(next->first);
    }
    case Command::next_phase:
      return go_to(next_phase_frame(keypoints(), frame_, phase_step()));
    case Command::next_worst: {
      const auto worst = worst_frame(prediction_.trajectory, keypoints(), order(), passed_by_);
      if (!worst) return tell("the tracking is trusted everywhere else");
      passed_by_.push_back(*worst);
      return go_to(*worst);
    }
    case Command::next_suspect: {
      const auto& suspects = prediction_.suspects;
      if (suspects.empty()) return tell("no swapped legs are suspected");
      const auto next = std::ranges::upper_bound(suspects, frame_);
      return go_to(next == suspects.end() ? suspects.front() : *next);
    }
    default:
      return;
  }
}

void AnnotationSession::go_to(int frame) {
  frame = std::clamp(frame, 0, std::max(frame_count() - 1, 0));
  if (frame == frame_) return;
  frame_ = frame;
  tell("");
  ask_first_missing();
}

}  // namespace stride
