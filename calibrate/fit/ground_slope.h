#pragma once

#include <optional>

#include "calibrate/fit/fit.h"
#include "extract/skeleton/trajectory.h"

namespace stride::fit {

/// The roll of the ground in the image (mean positive where it rises to the right): a marked floor
/// line, else the way along which the background passes a camera that goes along. None if the
/// camera stands, or if the background passes by less than half a frame or not within a degree.
std::optional<Prior> ground_roll(const Trajectory& trajectory);

}  // namespace stride::fit
