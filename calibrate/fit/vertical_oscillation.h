#pragma once

#include "calibrate/fit/stride_fit.h"

namespace stride::fit {

/// Tells the pelvis' own rise and fall from the camera's movement: the latter is slow, the former
/// repeats twice a stride. Robust linear least squares on the pelvis' height in the image.
VerticalOscillation measure_vertical_oscillation(const StrideFit& fit, const Marks& observations);

}  // namespace stride::fit
