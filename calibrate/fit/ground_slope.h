#pragma once

#include <optional>

#include "calibrate/fit/fit.h"
#include "extract/skeleton/trajectory.h"

namespace stride::fit {

/// Roll of the ground in the image (positive where it rises to the right), from a labelled floor
/// line, else from the direction in which the background passes a camera that follows. None if the
/// camera is at rest, if the background moves by less than half a frame, or if its direction is
/// uncertain by more than a degree.
std::optional<Prior> ground_roll(const Trajectory& trajectory);

}  // namespace stride::fit
