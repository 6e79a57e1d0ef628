#include "train/network/adam.h"

#include <cmath>

namespace stride::network {

template <typename Scalar>
double Adam<Scalar>::descend(Vector& parameters, Vector& gradient, double rate) {
  if (m.size() == 0) {
    m = Vector::Zero(parameters.size());
    v = Vector::Zero(parameters.size());
  }
  const auto norm = static_cast<double>(gradient.norm());
  if (options.gradient_norm_limit > 0 && norm > options.gradient_norm_limit)
    gradient *= static_cast<Scalar>(options.gradient_norm_limit / norm);

  ++step;
  const auto b1 = static_cast<Scalar>(options.beta1), b2 = static_cast<Scalar>(options.beta2);
  m = b1 * m + (1 - b1) * gradient;
  v.array() = b2 * v.array() + (1 - b2) * gradient.array().square();
  const double correction1 = 1 - std::pow(options.beta1, step);
  const double correction2 = 1 - std::pow(options.beta2, step);
  const auto a = static_cast<Scalar>(rate / correction1);
  const auto root = static_cast<Scalar>(1 / std::sqrt(correction2));
  if (options.weight_decay > 0) parameters *= static_cast<Scalar>(1 - rate * options.weight_decay);
  const auto epsilon = static_cast<Scalar>(options.epsilon);
  // Not Eigen's sqrt(), which is the processor's approximation refined: that differs by vendor.
  for (Eigen::Index i = 0; i < parameters.size(); ++i)
    parameters[i] -= a * m[i] / (std::sqrt(v[i]) * root + epsilon);
  return norm;
}

template struct Adam<float>;
template struct Adam<double>;

}  // namespace stride::network
