#include "train/network/normaliser.h"

#include <algorithm>
#include <cmath>

namespace stride::network {

Normaliser::Normaliser(const environment::Mirror& mirror) : mirror_(mirror) {
  const auto n = static_cast<Eigen::Index>(mirror.source.size());
  state_.mean = state_.squares = mean_ = Eigen::VectorXd::Zero(n);
  inverse_sd_ = Eigen::VectorXd::Ones(n);
}

void Normaliser::add(const Eigen::Ref<const Eigen::VectorXd>& features) {
  state_.count += 1;
  for (Eigen::Index i = 0; i < features.size(); ++i) {
    const double before = features[i] - state_.mean[i];
    state_.mean[i] += before / state_.count;
    state_.squares[i] += before * (features[i] - state_.mean[i]);
  }
}

void Normaliser::publish() {
  if (state_.count < 2) return;
  for (std::size_t i = 0; i < mirror_.source.size(); ++i) {
    const auto here = static_cast<Eigen::Index>(i);
    const auto there = static_cast<Eigen::Index>(mirror_.source[i]);
    const double other_mean = mirror_.sign[i] * state_.mean[there];
    const double half_gap = (state_.mean[here] - other_mean) / 2;
    const double variance =
        (state_.squares[here] + state_.squares[there]) / (2 * state_.count) + half_gap * half_gap;
    mean_[here] = (state_.mean[here] + other_mean) / 2;
    const double sd = std::sqrt(variance);
    inverse_sd_[here] = sd > kMinSd ? 1 / sd : 0;
  }
}

void Normaliser::set_state(const State& state) {
  state_ = state;
  publish();
}

}  // namespace stride::network
