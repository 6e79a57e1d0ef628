#pragma once

#include <optional>

#include "calibrate/fit/fit.h"
#include "extract/skeleton/trajectory.h"

namespace stride::fit {

/// The roll of the ground in the image (mean positive where it rises to the right): a marked floor
/// line, else the direction in which the background passes a camera that follows. None if the
/// camera stands, if the background passes by less than half a frame or leaves more than a degree,
/// or if camera_turns(). The sd includes by how much the runner's way tells another direction.
std::optional<Prior> ground_roll(const Trajectory& trajectory);

/// Whether the camera tilts or zooms as it follows: then the background passes in another direction
/// than the runner passes the background, by more than a degree. A tilt moves both alike, a zoom
/// moves what is off the middle of the picture.
bool camera_turns(const Trajectory& trajectory);

}  // namespace stride::fit
