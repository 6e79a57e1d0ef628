#pragma once

#include <vector>

#include "extract/skeleton/stride_period.h"
#include "extract/tracking/gaussian_process/gait_process.h"

namespace stride::gaussian_process {

/// Fits the kernels to the clicks by maximum marginal likelihood. The variances of the observations
/// are ignored: the noise of a click is a hyperparameter.
GaitPrior fit_gait_prior(const Observations& clicks, const PeriodBounds& bounds = {});

/// The same, and after it a second one of another period if the clicks hardly tell the two apart:
/// then the picture between them has to.
std::vector<GaitPrior> likely_gait_priors(const Observations& clicks, const PeriodBounds& bounds);

/// The kernels of a movement that does not repeat under which the clicks are most likely.
GaitPrior fit_passage_prior(const Observations& clicks);

/// The prior with the period, near its own, under which the observations are most likely, ways
/// included: what the picture shows between clicks tells periods apart that the clicks cannot. Of a
/// long clip its middle is used. A prior without a period stays as it is.
GaitPrior with_period_of(const GaitPrior& prior, const Observations& observations);

/// Posterior mean of each part at each time: first the pelvis, then the others relative to it. NaN
/// for a part without observations. Variances, which take most of the time, are 0 unless asked for.
Estimates estimate(const GaitPrior& prior, const Observations& observations,
                   const std::vector<double>& times_s, bool with_variance = true);

}  // namespace stride::gaussian_process
