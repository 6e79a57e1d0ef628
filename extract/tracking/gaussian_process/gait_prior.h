#pragma once

#include <vector>

#include "extract/tracking/gaussian_process/gait_process.h"

namespace stride::gaussian_process {

/// Fits the kernels to the clicks by maximum marginal likelihood. The variances of the observations
/// are ignored: the noise of a click is a hyperparameter.
GaitPrior fit_gait_prior(const Observations& clicks);

/// Refits the period alone, near the prior's own, to all observations including displacements. The
/// motion between clicks separates periods that the clicks cannot separate.
GaitPrior with_period_of(const GaitPrior& prior, const Observations& observations);

/// Posterior mean of each part at each time: first the pelvis, then the others relative to it. NaN
/// for a part without observations. Variances, which take most of the time, are 0 unless asked for.
Estimates estimate(const GaitPrior& prior, const Observations& observations,
                   const std::vector<double>& times_s, bool with_variance = true);

}  // namespace stride::gaussian_process
