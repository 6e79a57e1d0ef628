// AnnotationSession: actions of the keys.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "extract/annotation/asking.h"
#include "extract/annotation/checks.h"
#include "extract/annotation/session/session.h"
#include "extract/io/error.h"

namespace stride::annotation {
namespace {

constexpr double kNudge = 0.25;  // px
constexpr double kCloseUp = 8;   // canvas px per image px

}  // namespace

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
  if (mode_ == Mode::length_from && what == Command::erase) {
    mode_ = Mode::click;
    return take_line_away();
  }
  if (what != Command::none) command(what, key);
}

void AnnotationSession::answer(int key) {
  ClipSettings settings = settings_of(keypoints());
  const bool right = key == 'r' || key == key::kRight, left = key == 'l' || key == key::kLeft;
  if (mode_ == Mode::ask_direction) {
    if (!right && !left) return;
    settings.direction = right ? Facing::right : Facing::left;
    // A runner to the right shows the right side to the camera.
    mode_ = Mode::ask_near_leg;
    return edit_settings(fmt::format("runs to the {}", kFacings[*settings.direction]), settings);
  }
  if (!right && !left && key != key::kEnter) return;
  const bool nearer = key == key::kEnter ? settings.direction != Facing::left : right;
  settings.near_leg = nearer ? Side::right : Side::left;
  mode_ = Mode::click;
  edit_settings(fmt::format("the {} leg is near", kSides[*settings.near_leg]), settings);
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
  if (typing_.what == Command::calibration_line) return take_length(typing_.text);
  double factor = 0;
  const char* end = typing_.text.data() + typing_.text.size();
  const auto parsed = std::from_chars(typing_.text.data(), end, factor);
  require(parsed.ec == std::errc() && parsed.ptr == end && factor > 0 && factor <= 1000,
          "slow motion = '{}': must be how many seconds of video show one second, as 4 or 2.5",
          typing_.text);
  settings.slow_motion = factor;
  edit_settings(fmt::format("slow motion {}", factor), settings);
}

void AnnotationSession::choose_part(int digit) {
  // 1 … 7: the order without hips; 8, 9, 0: hips and head.
  constexpr std::array<std::size_t, 10> kPlace{9, 0, 1, 2, 3, 5, 6, 7, 4, 8};
  const auto all = asking_order(near_leg(), true, true);
  last_ = asked_ = all[kPlace[static_cast<std::size_t>(digit)]];
}

void AnnotationSession::mark_absent() {
  if (!asked_) return tell("every part of this frame is clicked; choose one by its digit", true);
  const BodyPart part = *asked_;
  place(part, Eigen::Vector2d::Zero(), ClickState::absent);
  advance(part);
}

void AnnotationSession::accept_ghost() {
  const TrajectoryFrame* ghost = predicted(frame_);
  if (!asked_ || !ghost || !(*ghost)[*asked_].present())
    return tell("no prediction of this part here yet", true);
  const BodyPart part = *asked_;
  place(part, view_.inside((*ghost)[part].p_px), ClickState::seen);
  advance(part);
}

void AnnotationSession::take_back(bool again) {
  const auto change = again ? journal_.redo() : journal_.undo();
  const char* word = again ? "redone" : "undone";
  if (!change) return tell(fmt::format("nothing to be {}", word), true);
  if (!change->clicks.empty()) go_to(change->clicks.front().frame);
  ask_first_missing();
  if (change->clicks.size() == 1) {
    last_ = change->clicks.front().part;
    if (!change->clicks.front().click) asked_ = last_;
  }
  tell(fmt::format("{}: {}", word, change->what));
}

void AnnotationSession::close_up() {
  if (view_.scale > view_.fitting_scale() * 1.001) return view_.fit();
  const Eigen::Vector2d middle(view_.area.x + view_.area.width / 2.0,
                               view_.area.y + view_.area.height / 2.0);
  view_.zoom(kCloseUp, view_.contains(mouse_) ? mouse_ : middle);
}

void AnnotationSession::zoom_to_runner() {
  const ClickedFrame* here = clicked(frame_);
  const TrajectoryFrame* tracked = predicted(frame_);
  Eigen::Array2d low = Eigen::Array2d::Constant(1e9), high = -low;
  for (const BodyPart part : kBodyParts) {
    Eigen::Vector2d p = Eigen::Vector2d::Constant(std::nan(""));
    if (tracked) p = (*tracked)[part].p_px;
    if (here && here->placed(part)) p = (*here)[part]->p_px;
    if (!p.allFinite()) continue;
    low = low.min(p.array());
    high = high.max(p.array());
  }
  if ((high < low).any()) return tell("no part of the runner is known here yet", true);
  constexpr double kAround = 1.6;  // arms and head are above
  const double size_px = std::max((high - low).maxCoeff(), 20.0);
  const Eigen::Vector2d middle = (0.5 * (low + high)).matrix();
  view_.fit();
  const Eigen::Vector2d canvas = view_.to_canvas(middle),
                        centre(view_.area.x + view_.area.width / 2.0,
                               view_.area.y + view_.area.height / 2.0);
  view_.zoom(std::min(view_.area.width, view_.area.height) / (kAround * size_px), canvas);
  view_.pan(centre - view_.to_canvas(middle));
}

void AnnotationSession::mark_floor_from_feet() {
  ClipSettings settings = settings_of(keypoints());
  settings.floor = floor_from_feet(prediction_.trajectory, stride_frames());
  if (!settings.floor)
    return tell("the feet stand at one place of the picture: mark the floor with o", true);
  edit_settings("floor line from the standing feet", settings);
}

void AnnotationSession::command(Command command, int key) {
  ClipSettings settings = settings_of(keypoints());
  switch (command) {
    case Command::choose_part:
      return choose_part(key - '0');
    case Command::absent:
      return mark_absent();
    case Command::accept:
      return accept_ghost();
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
    case Command::zoom_to_runner:
      return zoom_to_runner();
    case Command::play:
      playing_ = !playing_;
      return;
    case Command::swap_legs:
      return swap_legs();
    case Command::begin_range:
      range_from_ = frame_;
      return tell(fmt::format("a range begins at frame {}; go to its end", frame_));
    case Command::trim:
      return set_trim();
    case Command::undo:
    case Command::redo:
      return take_back(command == Command::redo);
    case Command::zoom:
      return close_up();
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
      return mark_floor_from_feet();
    case Command::calibration_line:
      mode_ = Mode::length_from;
      return;
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

void AnnotationSession::go_to_worst() {
  const auto worst = worst_point(prediction_.trajectory, keypoints(), order(), passed_points_);
  if (!worst) return tell("no other point is left", false);
  passed_points_.push_back(*worst);
  go_to(worst->frame);
  asked_ = worst->part;
  tell(fmt::format("the least certain point: {}; click where it is, or n: the next",
                   spoken(worst->part, near_leg())));
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
      if (options_.corrects) return go_to_worst();
      const auto worst = worst_frame(prediction_.trajectory, keypoints(), order(), passed_by_);
      if (!worst) return tell("everything else has been followed in the picture");
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

}  // namespace stride::annotation
