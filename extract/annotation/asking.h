#pragma once

#include <string>
#include <vector>

#include "extract/skeleton/keypoints.h"
#include "extract/skeleton/trajectory.h"

namespace stride::annotation {

/// In which order the parts of a frame are asked for: pelvis, the near leg downwards, the far leg
/// downwards, then what is asked for on request.
std::vector<BodyPart> asking_order(const std::string& near_leg, bool hips, bool head);

/// "near knee (right)", "pelvis": how a part is called on the screen.
std::string spoken(BodyPart part, const std::string& near_leg);

bool is_near(BodyPart part, const std::string& near_leg);

/// The first part of `order` after `after` without a click on the frame, going round; nothing if
/// the frame has all.
std::optional<BodyPart> next_missing(const Keypoints& keypoints, int frame,
                                     const std::vector<BodyPart>& order,
                                     std::optional<BodyPart> after);

/// Frames at which a runner is asked for, equally spaced in the stride and counted from the first
/// click, `step_frames` apart. Returns the first beyond `frame`.
int next_phase_frame(const Keypoints& keypoints, int frame, double step_frames);

/// The stride in frames from the crossings of the ankles: twice the median time between two of
/// them. 0 with fewer than two crossings.
double stride_from_crossings(const Trajectory& trajectory);

}  // namespace stride::annotation
