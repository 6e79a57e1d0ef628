#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace stride::network {

struct AdamOptions {
  double beta1 = 0.9, beta2 = 0.999, epsilon = 1e-8;
  double gradient_norm_limit = 0;  // larger gradients are scaled down to it; 0: no limit
  double weight_decay = 0;         // decoupled (Loshchilov, Hutter 2019), times the rate
};

/// Adam (Kingma, Ba 2015, Algorithm 1) over one vector of parameters.
template <typename Scalar>
struct Adam {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  AdamOptions options = {};
  Vector m = {}, v = {};  // first and second moment; empty before the first step
  std::int64_t step = 0;  // t

  /// θ ← θ − rate · m̂ / (√v̂ + ε). Returns the norm of the gradient before it was limited.
  double descend(Vector& parameters, Vector& gradient, double rate);
};

extern template struct Adam<float>;
extern template struct Adam<double>;

}  // namespace stride::network
