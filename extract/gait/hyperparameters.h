#pragma once

#include <vector>

#include "extract/gait/samples.h"

namespace stride {

struct Fitted {
  GaitKernel kernel;
  double cost;  // −log posterior probability, without constants
};

double cost(const GaitKernel& kernel, const std::vector<GroupData>& groups);

/// Pattern search in the logarithms, one hyperparameter after another.
Fitted refined(Fitted best, const std::vector<GroupData>& groups, int rounds);

/// The best kernels of a scan over the period, refined. The likelihood has a peak at every alias of
/// the clicks' spacing; the nearest shows the stride backwards in time. `facing`: +1 if the runner
/// faces right, −1 left, 0 not known.
Fitted fitted(const std::vector<GroupData>& groups, int facing);

}  // namespace stride
