#pragma once

#include <ceres/problem.h>

#include <array>
#include <vector>

#include "calibrate/fit/solver/stride_fit.h"

namespace stride::fit {

/// Stance phases of a foot, in its own cycle.
struct StanceCue {
  BodyPart part_r = BodyPart::toe_r;  // what stands; of the left leg its mirror image
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
inline constexpr double kTukey = 4.685, kCauchy = 2.385;  // 95 % efficient under normal noise

/// A parameter beside the runner's: how far below the pelvis the ground is, m. It starts a leg's
/// length below.
double first_ground_m(const Runner& runner);

/// Where a heel is expected on the foot, from the ankle, m: the model's on a foot of usual size.
std::array<double, heel::size> usual_heel(const FitProblem& problem);

/// The problem at the present state and noise of `fit`, of whose blocks it holds the addresses and
/// that of `ground_m`: residuals, priors, bounds, and what is held fixed.
void build(const FitProblem& problem, StrideFit& fit, Loss loss, double* ground_m,
           ceres::Problem& ceres);

/// Weak priors on any runner, which matter only where the points say nothing.
void add_priors(const FitProblem& problem, StrideFit& fit, ceres::Problem& ceres);

}  // namespace stride::fit
