#include "train/ppo/scaled_critic.h"

#include <algorithm>
#include <cmath>

namespace stride::ppo {
namespace {

constexpr double kSlowest = 0.02;  // share of a batch in the running scale, at least
constexpr double kSmallestScale = 1e-3;

}  // namespace

Vector ScaledCritic::values(const Eigen::Ref<const Matrix>& states,
                            network::Mlp<float>::Workspace& work) const {
  const Matrix& out = net.forward(states, work);
  return (out.row(0).array() * static_cast<float>(scale) + static_cast<float>(shift))
      .matrix()
      .transpose();
}

Vector ScaledCritic::scaled(const Vector& returns) const {
  return (returns.array() - static_cast<float>(shift)) / static_cast<float>(scale);
}

void ScaledCritic::rescale(const Vector& returns) {
  const double mean = returns.cast<double>().mean();
  const double square = (returns.cast<double>().array() - shift).square().mean();
  batches += 1;
  const double share = std::max(kSlowest, 1 / batches);
  const double new_shift = shift + share * (mean - shift);
  // E(x − shift′)² from E(x − shift)²: old and new data share the running second moment.
  const double second = (1 - share) * scale * scale + share * square;
  const double moved = new_shift - shift;
  const double new_scale =
      std::max(kSmallestScale, std::sqrt(std::max(0.0, second - moved * moved)));

  const auto blocks = net.blocks();
  const auto& weight = blocks[blocks.size() - 2];
  const auto& bias = blocks.back();
  const auto factor = static_cast<float>(scale / new_scale);
  net.parameters().segment(weight.offset, weight.rows * weight.columns) *= factor;
  float& b = net.parameters()[bias.offset];
  b = static_cast<float>((scale * static_cast<double>(b) + shift - new_shift) / new_scale);
  shift = new_shift;
  scale = new_scale;
}

}  // namespace stride::ppo
