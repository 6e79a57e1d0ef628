#pragma once

#include <string>
#include <vector>

#include "extract/skeleton/keypoints.h"
#include "extract/skeleton/trajectory.h"

namespace stride::annotation {

/// The order in which the parts of a frame are asked for: pelvis, near leg downwards, far leg
/// downwards, optional parts.
std::vector<BodyPart> asking_order(Side near_leg, bool hips, bool head);

/// The name of a part on the screen: "near knee (right)", "pelvis".
std::string spoken(BodyPart part, Side near_leg);

bool is_near(BodyPart part, Side near_leg);

/// The first part of `order` after `after`, cyclically, that has no click on the frame; nothing if
/// the frame is complete.
std::optional<BodyPart> next_missing(const Keypoints& keypoints, int frame,
                                     const std::vector<BodyPart>& order,
                                     std::optional<BodyPart> after);

/// The next phase frame after `frame`. Phase frames are `step_frames` apart, counted from the first
/// click.
int next_phase_frame(const Keypoints& keypoints, int frame, double step_frames);

/// Length of the stride in frames: twice the median time between two crossings of the ankles. 0
/// with fewer than two crossings.
double stride_from_crossings(const Trajectory& trajectory);

}  // namespace stride::annotation
