#pragma once

#include <Eigen/Core>

#include "extract/io/random.h"

namespace stride::ddpg {

/// Ornstein–Uhlenbeck noise on actions, one step a decision (Lillicrap et al. 2016, Sec. 7): x ← x
/// − θx + σ√(2θ − θ²) ξ, so that σ is the stationary standard deviation for any θ; θ = 1 is white
/// noise.
struct OuNoise {
  double theta = 0.1;
  Eigen::VectorXd x;

  /// The next value, of standard deviation sigma in each element.
  const Eigen::VectorXd& step(double sigma, Random& random) {
    const double kick = sigma * std::sqrt(theta * (2 - theta));
    for (double& v : x) v += -theta * v + kick * normal(random);
    return x;
  }
  /// Draws x from its stationary distribution, so that noise does not start at 0.
  void start(Eigen::Index size, double sigma, Random& random) {
    x.resize(size);
    for (double& v : x) v = sigma * normal(random);
  }
};

}  // namespace stride::ddpg
