#include "train/ppo/rollout_batch.h"

namespace stride::ppo {

void estimate_advantages(double gamma, double lambda, RolloutBatch& batch) {
  const int n = batch.environments, decisions = batch.decisions();
  const auto g = static_cast<float>(gamma), decay = static_cast<float>(gamma * lambda);
  batch.advantages.resize(decisions);
  batch.returns.resize(decisions);
  Eigen::Index truncated = batch.truncated_values.size();
  Vector later = Vector::Zero(n);  // A of the next decision
  for (int i = decisions - 1; i >= 0; --i) {
    const EpisodeEnd end = batch.ends[static_cast<std::size_t>(i)];
    float next = batch.values[i + n];
    if (end == EpisodeEnd::terminated) next = 0;
    if (end == EpisodeEnd::truncated) next = batch.truncated_values[--truncated];
    const float delta = batch.rewards[i] + g * next - batch.values[i];
    float& advantage = later[i % n];
    advantage = delta + (end == EpisodeEnd::none ? decay * advantage : 0.0f);
    batch.advantages[i] = advantage;
    batch.returns[i] = advantage + batch.values[i];
  }
}

}  // namespace stride::ppo
