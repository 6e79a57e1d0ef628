#pragma once

#include "calibrate/fit/initial_guess.h"
#include "calibrate/fit/solver/problem.h"

namespace stride::fit {

/// Where a guessed period starts.
StrideFit start(const FitProblem& problem, const StridePeriod& guess);

/// The largest number of harmonics that the points can determine: two for a stride seen at five
/// phases.
int max_harmonics(const Marks& observations, const Runner& runner);

}  // namespace stride::fit
