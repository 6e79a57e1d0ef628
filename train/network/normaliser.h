#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "train/environment/mirror.h"

namespace stride::network {

/// Running mean and variance of features (Welford), of every sample and its mirror image, so that
/// normalising and mirroring commute.
class Normaliser {
 public:
  static constexpr double kLimit = 10;    // normalised features are clipped to ±kLimit
  static constexpr double kMinSd = 1e-4;  // a feature that never moves counts as 0

  explicit Normaliser(const environment::Mirror& mirror);

  void add(const Eigen::Ref<const Eigen::VectorXd>& features);
  /// Updates mean() and inverse_sd() with the samples added so far.
  void publish();

  const Eigen::VectorXd& mean() const { return mean_; }
  const Eigen::VectorXd& inverse_sd() const { return inverse_sd_; }

  /// Normalises columns in place.
  template <typename Matrix>
  void apply(Matrix& features) const {
    using Scalar = typename Matrix::Scalar;
    const auto limit = static_cast<Scalar>(kLimit);
    for (Eigen::Index s = 0; s < features.cols(); ++s)
      features.col(s) =
          ((features.col(s) - mean_.cast<Scalar>()).array() * inverse_sd_.cast<Scalar>().array())
              .min(limit)
              .max(-limit);
  }

  /// The state for a checkpoint.
  struct State {
    double count = 0;
    Eigen::VectorXd mean, squares;  // Σ(x − mean)², not mirrored
  };
  const State& state() const { return state_; }
  void set_state(const State& state);

  /// Restores mean and inverse deviation of a trained agent.
  void fix(const Eigen::VectorXd& mean, const Eigen::VectorXd& inverse_sd) {
    mean_ = mean;
    inverse_sd_ = inverse_sd;
  }

 private:
  environment::Mirror mirror_;
  State state_;
  Eigen::VectorXd mean_, inverse_sd_;
};

}  // namespace stride::network
