#pragma once

#include "calibrate/aperiodic/passage.h"

namespace stride::aperiodic {

/// Where the fit starts: limbs by their median, and splines through the angles of each frame, by
/// linear least squares. `failure` says what is missing.
PassageFit start(const fit::Marks& observations, const Directions& directions, double knot_s);

}  // namespace stride::aperiodic
