#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "extract/skeleton/keypoints.h"

namespace stride::annotation {

/// What a person says of the whole clip: the part of Keypoints that is not clicks.
struct ClipSettings {
  std::string direction, near_leg;
  double slow_motion = 1;
  std::optional<bool> treadmill;
  std::optional<FrameRange> trim;
  std::optional<FloorLine> floor;
  std::string notes;
};

ClipSettings settings_of(const Keypoints& keypoints);

struct ClickChange {
  int frame = 0;
  double video_time_s = 0;  // of that frame, without slow motion
  BodyPart part = BodyPart::pelvis;
  std::optional<Click> click;  // the new one; none: taken away
};

/// One step that a person takes, and takes back, as a whole.
struct Change {
  std::string what;  // "pelvis on frame 12", for the status line
  std::vector<ClickChange> clicks;
  std::optional<ClipSettings> settings;
};

/// Keypoints that are edited by changes, each of which can be taken back and made again.
class AnnotationDocument {
 public:
  explicit AnnotationDocument(Keypoints keypoints);

  const Keypoints& keypoints() const { return keypoints_; }
  int revision() const { return revision_; }  // grows with every edit, undo and redo

  /// Throws Error, and changes nothing, where the result would break the rules of the format.
  void apply(Change change);
  /// The change that this made; nothing if there was none to take back or to make again.
  std::optional<Change> undo();
  std::optional<Change> redo();

 private:
  /// Makes the change and returns the one that takes it back.
  Change exchange(const Change& change);

  std::optional<Change> take(std::vector<Change>& from, std::vector<Change>& to);

  Keypoints keypoints_;
  std::map<int, double> video_times_s_;  // by frame, of every frame that ever had a click
  std::vector<Change> undo_, redo_;      // the last is the next to be made
  int revision_ = 0;
};

}  // namespace stride::annotation
