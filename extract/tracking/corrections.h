#pragma once

#include "extract/skeleton/trajectory.h"

namespace stride::tracking {

/// A detector's points with a person's clicks in place of them where there are any, and what the
/// clicks teach: a joint that the detector has too high on the shank wherever it was clicked is
/// moved along the limb on every frame (shrunk towards nothing where few clicks tell it), and what
/// remains at a click fades away over the frames next to it. Both runners must have the same legs
/// on the same side. Frames of `clicks` that the detector does not have are added.
Trajectory corrected(const Trajectory& detected, const Trajectory& clicks);

}  // namespace stride::tracking
