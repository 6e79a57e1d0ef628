#pragma once

#include <vector>

#include "calibrate/fit/initial_guess.h"
#include "calibrate/fit/stride_fit.h"

namespace stride::fit {

/// Phases at which the foot of a leg stands, by its own cycle.
struct StanceCue {
  BodyPart part_r = BodyPart::toe_r;  // what stands; of the left leg its mirror image
  std::vector<double> phases;         // empty: not known
};

/// What the fit is made of, besides its present state.
struct FitProblem {
  const Marks& observations;
  const SagittalModel& model;
  Directions directions;
  FitOptions options;
  StanceCue stance;
};

/// Cauchy's loss finds the way from afar, Tukey's gives gross outliers no say at all.
enum class Loss { cauchy, tukey };

struct Solution {
  double cost = 0;
};

/// Where a guessed period starts.
StrideFit start(const FitProblem& problem, const StridePeriod& guess);

/// One solve with Ceres from the present state at its present noise.
/// `tolerance`: the relative decrease of the cost at which it ends.
Solution solve(const FitProblem& problem, StrideFit& fit, Loss loss, double tolerance);

/// Residuals, outliers, the robust standard deviation of a mark, and how much frames repeat one
/// another.
void estimate_noise(const FitProblem& problem, StrideFit& fit);

/// (JᵀJ)⁻¹ at the solution, the pelvis of every frame eliminated.
void estimate_covariance(const FitProblem& problem, StrideFit& fit);

/// How many harmonics the marks can tell at all: two for a stride seen at five phases.
int max_harmonics(const Marks& observations, const Runner& runner);

}  // namespace stride::fit
