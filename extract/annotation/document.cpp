#include "extract/annotation/document.h"

#include <utility>

namespace stride::annotation {

ClipSettings settings_of(const Keypoints& k) {
  return {k.direction, k.near_leg,         k.slow_motion, k.treadmill,        k.trim,
          k.floor,     k.calibration_line, k.notes,       k.corrects_network, k.movement};
}

namespace {

void set(Keypoints& k, const ClipSettings& settings) {
  k.direction = settings.direction;
  k.near_leg = settings.near_leg;
  k.slow_motion = settings.slow_motion;
  k.treadmill = settings.treadmill;
  k.trim = settings.trim;
  k.floor = settings.floor;
  k.calibration_line = settings.calibration_line;
  k.notes = settings.notes;
  k.corrects_network = settings.corrects_network;
  k.movement = settings.movement;
}

bool is_empty(const ClickedFrame& frame) {
  for (const auto& click : frame.clicks)
    if (click) return false;
  return frame.other_json.empty();
}

}  // namespace

AnnotationDocument::AnnotationDocument(Keypoints keypoints) : keypoints_(std::move(keypoints)) {
  for (const auto& [number, frame] : keypoints_.frames)
    video_times_s_[number] = frame.time_s * keypoints_.slow_motion;
}

Change AnnotationDocument::exchange(const Change& change) {
  Change back{change.what, {}, {}};
  if (change.settings) {
    back.settings = settings_of(keypoints_);
    const bool retimed = change.settings->slow_motion != keypoints_.slow_motion;
    set(keypoints_, *change.settings);
    if (retimed)
      for (auto& [number, frame] : keypoints_.frames)
        frame.time_s = video_times_s_[number] / keypoints_.slow_motion;
  }
  for (const ClickChange& edit : change.clicks) {
    ClickedFrame& frame = keypoints_.frames[edit.frame];
    video_times_s_[edit.frame] = edit.video_time_s;
    frame.time_s = edit.video_time_s / keypoints_.slow_motion;
    back.clicks.insert(back.clicks.begin(),
                       {edit.frame, edit.video_time_s, edit.part, frame[edit.part]});
    frame[edit.part] = edit.click;
    if (is_empty(frame)) keypoints_.frames.erase(edit.frame);
  }
  ++revision_;
  return back;
}

void AnnotationDocument::apply(const Change& change) {
  Change back = exchange(change);
  try {
    check(keypoints_, change.what);
  } catch (...) {
    exchange(back);
    throw;
  }
  undo_.push_back(std::move(back));
  redo_.clear();
}

std::optional<Change> AnnotationDocument::take(std::vector<Change>& from, std::vector<Change>& to) {
  if (from.empty()) return std::nullopt;
  Change change = std::move(from.back());
  from.pop_back();
  to.push_back(exchange(change));
  return change;
}

std::optional<Change> AnnotationDocument::undo() { return take(undo_, redo_); }
std::optional<Change> AnnotationDocument::redo() { return take(redo_, undo_); }

}  // namespace stride::annotation
