#pragma once

#include "train/network/adam.h"
#include "train/network/mlp.h"
#include "train/ppo/bernoulli.h"

namespace stride::ppo {

/// A critic that learns returns of mean 0 and deviation 1 whatever their scale is: V = scale · net
/// + shift. When the scale moves, the last layer is changed so that V stays (van Hasselt et al.
/// 2016, PopArt).
struct ScaledCritic {
  network::Mlp<float> net;
  network::Adam<float> adam;
  double shift = 0, scale = 1;
  double batches = 0;  // that the scale has seen

  /// V of each column.
  Vector values(const Eigen::Ref<const Matrix>& states, network::Mlp<float>::Workspace& work) const;
  /// What the network is to say for those returns.
  Vector scaled(const Vector& returns) const;
  /// Moves shift and scale towards those of a batch of returns; V does not change.
  void rescale(const Vector& returns);
};

}  // namespace stride::ppo
