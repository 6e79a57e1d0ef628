#include "train/ppo/bernoulli.h"

namespace stride::ppo {
namespace {

/// log(1 + eˣ) without overflow.
template <typename Array>
auto softplus(const Array& x) {
  return x.max(0.0f) + (1.0f + (-x.abs()).exp()).log();
}

}  // namespace

Vector log_probability(const Eigen::Ref<const Matrix>& logits,
                       const Eigen::Ref<const Matrix>& actions) {
  const Eigen::ArrayXXf against = (1.0f - 2.0f * actions.array()) * logits.array();
  return -softplus(against).colwise().sum().matrix().transpose();
}

Vector divergence(const Eigen::Ref<const Matrix>& before, const Eigen::Ref<const Matrix>& now) {
  const Eigen::ArrayXXf p = before.array().logistic();
  const Eigen::ArrayXXf z0 = before.array(), z = now.array();
  return (p * (z0 - z) + softplus(z) - softplus(z0)).colwise().sum().matrix().transpose();
}

Vector entropy(const Eigen::Ref<const Matrix>& logits) {
  const Eigen::ArrayXXf z = logits.array();
  return (softplus(z) - z * z.logistic()).colwise().sum().matrix().transpose();
}

Matrix log_probability_gradient(const Eigen::Ref<const Matrix>& logits,
                                const Eigen::Ref<const Matrix>& actions) {
  return (actions.array() - logits.array().logistic()).matrix();
}

Matrix entropy_gradient(const Eigen::Ref<const Matrix>& logits) {
  const Eigen::ArrayXXf p = logits.array().logistic();
  return (-logits.array() * p * (1.0f - p)).matrix();
}

}  // namespace stride::ppo
