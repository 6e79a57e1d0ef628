#pragma once

#include "calibrate/fit/solver/problem.h"

namespace stride::fit {

/// Updates residuals, outliers, the robust standard deviation of a point, and the correlation of
/// frames.
void estimate_noise(const FitProblem& problem, StrideFit& fit);

}  // namespace stride::fit
