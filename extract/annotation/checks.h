#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "extract/skeleton/keypoints.h"
#include "extract/skeleton/trajectory.h"

namespace stride::annotation {

struct BoneWarning {
  BodyPart from, to;
  double length_px = 0, usual_px = 0;
};

/// Bones of the clicked frame that are more than 12 % longer or shorter than usual (the median over
/// the clicked frames, of at least four): perspective, a click beside the joint, or swapped legs.
/// In a side view a thigh and a shank keep their length to 7 % in good clips.
std::vector<BoneWarning> bone_warnings(const Keypoints& keypoints, int frame);

/// The runner's leg, pelvis to knee to ankle, as clicked: the median over frames and sides; nothing
/// if no leg was clicked whole.
std::optional<double> clicked_leg_px(const Keypoints& keypoints);

/// The frame with the least certain parts, except within two frames of a click and in `passed_by`.
/// Nothing if every part was followed in the picture.
std::optional<int> worst_frame(const Trajectory& prediction, const Keypoints& keypoints,
                               const std::vector<BodyPart>& parts,
                               const std::vector<int>& passed_by);

/// A point of a detector that a person had better look at.
struct WorstPoint {
  int frame = 0;
  BodyPart part = BodyPart::pelvis;
};

/// The point whose correction is expected to take most from the error of the whole clip: its own,
/// by its confidence, and on all frames what is left of the detector's own idea of the joint, which
/// a click on a point that the detector is sure of tells best. Not within three frames of a click
/// on the same part, nor what was passed by. Nothing if no part is left.
std::optional<WorstPoint> worst_point(const Trajectory& prediction, const Keypoints& keypoints,
                                      const std::vector<BodyPart>& parts,
                                      const std::vector<WorstPoint>& passed_by);

/// A line through the lowest positions of the feet. Nothing if they lie within a tenth of the
/// picture's width, as on a treadmill.
std::optional<FloorLine> floor_from_feet(const Trajectory& trajectory, double stride_frames);

}  // namespace stride::annotation
