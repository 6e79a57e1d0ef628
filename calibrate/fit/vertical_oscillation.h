#pragma once

#include "calibrate/fit/solver/stride_fit.h"

namespace stride::fit {

/// Separates the rise and fall of the pelvis, which repeats twice a stride, from slow camera
/// motion, by robust linear least squares on the pelvis' height in the image.
VerticalOscillation measure_vertical_oscillation(const StrideFit& fit, const Marks& observations);

}  // namespace stride::fit
