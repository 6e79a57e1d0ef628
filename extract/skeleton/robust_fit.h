#pragma once

#include <Eigen/Core>
#include <functional>

namespace stride {

/// 1.4826 medians of the absolute residuals are their standard deviation where they are normal.
inline constexpr double kSigmaPerMedian = 1.4826;

struct RobustOptions {
  int rounds = 6;
  double spread_per_median = 1;  // or kSigmaPerMedian
  double least_spread = 0;       // > 0
  double width = 2;              // of the weights, in spreads
};

struct RobustFit {
  Eigen::VectorXd distances;  // of the last round
  double spread = 0;          // their median times `spread_per_median`, at least `least_spread`
};

/// Least squares with these weights of its squared residuals; returns the residuals' absolute
/// values.
using WeightedFit = std::function<Eigen::VectorXd(const Eigen::VectorXd& weights)>;

/// Iteratively reweighted least squares with Cauchy's weights (Holland and Welsch 1977): fits, then
/// gives residual i of distance d_i the weight
///
///     w_i = prior_i / (1 + (d_i / (width · spread))²)
RobustFit robust_fit(const Eigen::VectorXd& prior_weights, const RobustOptions& options,
                     const WeightedFit& fit);

}  // namespace stride
