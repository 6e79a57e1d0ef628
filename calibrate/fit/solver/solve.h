#pragma once

#include "calibrate/fit/solver/problem.h"

namespace stride::fit {

struct Solution {
  double cost = 0;
};

/// One solve with Ceres from the current state at its noise level. `tolerance`: relative decrease
/// of the cost at which it ends.
Solution solve(const FitProblem& problem, StrideFit& fit, Loss loss, double tolerance);

/// (JᵀJ)⁻¹ at the solution, with the pelvis of every frame eliminated.
void estimate_covariance(const FitProblem& problem, StrideFit& fit);

}  // namespace stride::fit
