#pragma once

#include "calibrate/fit/solver/problem.h"

namespace stride::fit {

/// Residuals, outliers, the robust standard deviation of a mark, and how much frames repeat one
/// another.
void estimate_noise(const FitProblem& problem, StrideFit& fit);

}  // namespace stride::fit
