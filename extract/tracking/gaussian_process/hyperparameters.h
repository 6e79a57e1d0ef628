#pragma once

#include <vector>

#include "extract/tracking/gaussian_process/samples.h"

namespace stride::gaussian_process {

struct Fitted {
  GaitKernel kernel;
  double cost;  // −log posterior probability, without constants
};

/// −log prior probability of the hyperparameters of legs or of the trunk.
double improbability(const GaitKernel& kernel, bool legs);

/// Of the kernels of legs.
double cost(const GaitKernel& kernel, const std::vector<GroupData>& groups);

/// Multiplies by a factor while that lowers the cost; if the first factor does not, divides.
template <typename State, typename Multiply, typename Cost>
void descend(State& best, double& least, double factor, int most_moves, Multiply multiply,
             Cost cost) {
  for (const double f : {factor, 1 / factor}) {
    int moves = 0;
    for (; moves < most_moves; ++moves) {
      State next = best;
      multiply(next, f);
      const double next_cost = cost(next);
      if (next_cost >= least) break;
      best = next;
      least = next_cost;
    }
    if (moves > 0) return;
  }
}

/// Pattern search in the logarithms, one hyperparameter after another.
Fitted refined(Fitted best, const std::vector<GroupData>& groups, int rounds);

/// Scans the period and refines the best kernels. The likelihood has a peak at every alias of the
/// clicks' spacing; the nearest alias is the stride reversed in time. `facing`: +1 if the runner
/// faces right, −1 left, 0 unknown.
Fitted fitted(const std::vector<GroupData>& groups, int facing);

}  // namespace stride::gaussian_process
