#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "extract/skeleton/keypoints.h"

namespace stride::annotation {

/// What is said about the whole clip: Keypoints without its clicks.
struct ClipSettings {
  std::optional<Facing> direction;
  std::optional<Side> near_leg;
  double slow_motion = 1;
  std::optional<bool> treadmill;
  std::optional<FrameRange> trim;
  std::optional<FloorLine> floor;
  std::optional<CalibrationLine> calibration_line;
  std::string notes;
  bool corrects_network = false;
  std::string movement = "run";  // a name of movements.toml
};

ClipSettings settings_of(const Keypoints& keypoints);

struct ClickChange {
  int frame = 0;
  double video_time_s = 0;  // of that frame, without slow motion
  BodyPart part = BodyPart::pelvis;
  std::optional<Click> click;  // the new one; none: removed
};

/// One edit, which is undone and redone as a whole.
struct Change {
  std::string what;  // "pelvis on frame 12", for the status line
  std::vector<ClickChange> clicks;
  std::optional<ClipSettings> settings;
};

/// Keypoints with undo and redo.
class AnnotationDocument {
 public:
  explicit AnnotationDocument(Keypoints keypoints);

  const Keypoints& keypoints() const { return keypoints_; }
  int revision() const { return revision_; }  // grows with every edit, undo and redo
  const std::vector<Change>& history() const { return undo_; }  // the last is undone first

  /// What an earlier program could have undone, for this one to undo.
  void remember(std::vector<Change> history) { undo_ = std::move(history); }

  /// Throws Error and changes nothing if the result would violate the rules of the format.
  void apply(const Change& change);
  /// The change that was made; nothing if there was none to undo or redo.
  std::optional<Change> undo();
  std::optional<Change> redo();

 private:
  /// Applies the change and returns its inverse.
  Change exchange(const Change& change);

  std::optional<Change> take(std::vector<Change>& from, std::vector<Change>& to);

  Keypoints keypoints_;
  std::map<int, double> video_times_s_;  // by frame, of every frame that ever had a click
  std::vector<Change> undo_, redo_;      // the last is the next to be applied
  int revision_ = 0;
};

}  // namespace stride::annotation
