#pragma once

#include "calibrate/fit.h"

namespace stride {

/// Tells the pelvis' own rise and fall from the camera's movement: the latter is slow, the former
/// repeats twice a stride. Robust linear least squares on the pelvis' height in the image.
Bounce measure_bounce(const StrideFit& fit, const Marks& observations);

}  // namespace stride
