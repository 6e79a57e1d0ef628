// AnnotationSession: edits of the keypoints.
#include <algorithm>
#include <charconv>

#include "extract/annotation/asking.h"
#include "extract/annotation/checks.h"
#include "extract/annotation/session/session.h"
#include "extract/io/error.h"

namespace stride::annotation {

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
                    state == ClickState::seen ? "" : fmt::format(": {}", kClickStates[state])),
        {{frame_, frames_.video_time_s(frame_), part, Click{p_px, state, ""}}},
        {}});
  last_ = part;
}

void AnnotationSession::advance(BodyPart after) {
  if (options_.corrects) {
    asked_.reset();
    return tell(message_ + "; n: the next worst point");
  }
  asked_ = next_missing(keypoints(), frame_, order(), after);
  if (asked_) return;
  const int next = next_phase_frame(keypoints(), frame_, phase_step());
  std::string complete = fmt::format("frame {} is complete", frame_);
  if (next >= frame_count()) return tell(complete + "; the clip ends before the next phase frame");
  if (prediction_.stride_frames == 0)
    complete += fmt::format("; {} frames on by guess: - fewer, = more", next - frame_);
  go_to(next);
  tell(complete);
}

void AnnotationSession::ask_first_missing() {
  last_.reset();
  if (options_.corrects) return asked_.reset();
  asked_ = next_missing(keypoints(), frame_, order(), std::nullopt);
}

void AnnotationSession::nudge(const Eigen::Vector2d& move_px) {
  const ClickedFrame* here = clicked(frame_);
  if (!last_ || !here || !here->placed(*last_))
    return tell("no point to move: click one, or choose it by its digit", true);
  place(*last_, view_.inside((*here)[*last_]->p_px + move_px), (*here)[*last_]->state);
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

void AnnotationSession::mark_length(const Eigen::Vector2d& p_px) {
  if (mode_ == Mode::length_from || measured_.frame != frame_) {
    measured_ = {frame_, p_px, p_px, 0};
    mode_ = Mode::length_to;
    return;
  }
  measured_.to_px = p_px;
  if (measured_.length_px() < kShortestLine_px)
    return tell(
        fmt::format("{:.1f} px apart: the ends must be {} px or more apart; click the other end",
                    measured_.length_px(), kShortestLine_px),
        true);
  mode_ = Mode::type;
  typing_ = {Command::calibration_line, ""};
}

void AnnotationSession::take_length(std::string text) {
  constexpr double kLeastLeg_m = 0.2, kMostLeg_m = 1.5;  // of any runner, hip to ankle
  std::ranges::replace(text, ',', '.');
  double length_m = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), length_m);
  const std::string rest = text.substr(static_cast<std::size_t>(parsed.ptr - text.data()));
  require(parsed.ec == std::errc() && (rest.empty() || rest == "m" || rest == " m"),
          "length = '{}': must be metres, as 1.5", text);
  measured_.length_m = length_m;
  check(measured_, "calibration line");
  std::string what = fmt::format("calibration line {}", text_of(measured_));
  if (const auto leg_px = clicked_leg_px(keypoints())) {
    const double leg_m = *leg_px * measured_.metres_per_pixel();
    require(leg_m >= kLeastLeg_m && leg_m <= kMostLeg_m,
            "length = {} m: the runner's leg would be {:.2f} m, a person's is about 0.85; click a "
            "length that lies where the runner runs",
            length_m, leg_m);
    what += fmt::format("; the leg is {:.2f} m by it", leg_m);
  }
  ClipSettings settings = settings_of(keypoints());
  settings.calibration_line = measured_;
  edit_settings(what, settings);
}

void AnnotationSession::take_line_away() {
  ClipSettings settings = settings_of(keypoints());
  if (!settings.calibration_line) return tell("no calibration line to take away", true);
  settings.calibration_line.reset();
  edit_settings("calibration line taken away", settings);
}

}  // namespace stride::annotation
