#pragma once

#include "extract/skeleton/trajectory.h"

namespace stride::tracking {

/// Median length of thigh and shank together; the size of the body where no leg is whole.
double leg_px(const Trajectory& points);

/// Lowers the confidence of a detector's points that make a thigh or a shank longer or shorter than
/// it is on the frames around. Which end is to blame is told by least squares: the points of a
/// frame are moved until the limbs have their usual lengths, the less sure ones farther, and who
/// had to move more than his confidence says is believed less. No point moves in the result.
/// Returns on how many frames a point lost more than half of it. `standard_deviation_legs`: of a
/// point of confidence 1, each coordinate; it falls as 1 / confidence.
int doubt_broken_limbs(Trajectory& points, double standard_deviation_legs);

}  // namespace stride::tracking
