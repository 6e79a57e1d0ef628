#pragma once

#include <vector>

#include "calibrate/fit/initial_guess.h"
#include "calibrate/fit/stride_fit.h"

namespace stride::fit {

/// Stance phases of a foot, in its own cycle.
struct StanceCue {
  BodyPart part_r = BodyPart::toe_r;  // the part on the ground; for the left leg its mirror image
  std::vector<double> phases;         // empty: not known
};

/// The constant inputs of a fit.
struct FitProblem {
  const Marks& observations;
  const SagittalModel& model;
  Directions directions;
  FitOptions options;
  StanceCue stance;
};

/// Cauchy's loss converges from afar; Tukey's ignores gross outliers.
enum class Loss { cauchy, tukey };

struct Solution {
  double cost = 0;
};

/// Where a guessed period starts.
StrideFit start(const FitProblem& problem, const StridePeriod& guess);

/// One solve with Ceres from the current state at its noise level. `tolerance`: relative decrease
/// of the cost at which it ends.
Solution solve(const FitProblem& problem, StrideFit& fit, Loss loss, double tolerance);

/// Updates residuals, outliers, the robust standard deviation of a point, and the correlation of
/// frames.
void estimate_noise(const FitProblem& problem, StrideFit& fit);

/// (JᵀJ)⁻¹ at the solution, with the pelvis of every frame eliminated.
void estimate_covariance(const FitProblem& problem, StrideFit& fit);

/// The largest number of harmonics that the points can determine: two for a stride seen at five
/// phases.
int max_harmonics(const Marks& observations, const Runner& runner);

}  // namespace stride::fit
