#pragma once

#include <optional>

#include "calibrate/fit/fit.h"
#include "extract/skeleton/trajectory.h"

namespace stride::fit {

/// The roll of the ground in the image (mean positive where it rises to the right): a marked floor
/// line, else the runner's way past the background of a camera that follows. The less sure, the
/// more that way and the background's own direction differ (the camera tilts) and the more the
/// runner grows (it zooms). None if the camera stands, or if the background passes by less than
/// half a frame or leaves more than a degree and a half.
std::optional<Prior> ground_roll(const Trajectory& trajectory);

}  // namespace stride::fit
