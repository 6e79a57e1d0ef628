#include "extract/skeleton/robust_fit.h"

#include <algorithm>

#include "extract/io/statistics.h"

namespace stride {

RobustFit robust_fit(const Eigen::VectorXd& prior_weights, const RobustOptions& options,
                     const WeightedFit& fit) {
  RobustFit result;
  Eigen::VectorXd weights = prior_weights;
  for (int round = 0; round < options.rounds; ++round) {
    result.distances = fit(weights);
    const double middle = median({result.distances.begin(), result.distances.end()});
    result.spread = std::max(options.least_spread, options.spread_per_median * middle);
    const double width = options.width * result.spread;
    weights = prior_weights.array() / (1 + (result.distances / width).array().square());
  }
  return result;
}

}  // namespace stride
