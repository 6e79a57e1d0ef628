#include "train/ddpg/learner_speed.h"

#include <chrono>

namespace stride::ddpg {
namespace {

using Clock = std::chrono::steady_clock;

/// Calls `work` repeatedly for so many seconds; returns seconds per call.
template <typename Work>
double time_of(double seconds, const Work& work) {
  work();
  const auto start = Clock::now();
  int calls = 0;
  double passed = 0;
  while (passed < seconds) {
    work();
    ++calls;
    passed = std::chrono::duration<double>(Clock::now() - start).count();
  }
  return passed / calls;
}

/// Multiplications and additions of the matrix products in one update. A weight costs two of them
/// for each sample forward, two for its own gradient, and two for the gradient of the layer below.
double operations(const AgentOptions& options, int states, int actions) {
  struct Weights {
    double all = 0, first = 0;
  };
  const auto weights = [](int inputs, const std::vector<int>& hidden, int outputs) {
    Weights w;
    for (const int neurons : hidden) {
      w.all += static_cast<double>(inputs) * neurons;
      if (w.first == 0) w.first = w.all;
      inputs = neurons;
    }
    w.all += static_cast<double>(inputs) * outputs;
    return w;
  };
  const Weights actor = weights(states, options.actor_hidden, actions);
  const Weights critic = weights(states + actions, options.critic_hidden, 1);
  const double targets = actor.all + critic.all;
  const double fit = critic.all * 3 - critic.first;  // nothing asks for the gradient by its inputs
  const double improve = critic.all * 2 + actor.all * 3 - actor.first;
  return 2.0 * options.batch * (targets + options.critics * fit + improve);
}

}  // namespace

template <typename Scalar>
LearnerSpeed measure_learner(const AgentOptions& options, int states, int actions, double seconds) {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  Random random(1);
  Agent<Scalar> agent(options, states, actions, random);
  Batch<Scalar> batch;
  batch.states = Matrix::Random(states, options.batch);
  batch.next_states = Matrix::Random(states, options.batch);
  batch.actions = (Matrix::Random(actions, options.batch).array() + 1) / 2;
  batch.rewards = Matrix::Random(1, options.batch);
  batch.discounts.setConstant(options.batch, Scalar(0.97));
  const double update_s = time_of(seconds, [&] { agent.update(batch, 1); });

  typename network::Mlp<Scalar>::Workspace work;
  const Matrix one = Matrix::Random(states, 1);
  const double action_s = time_of(seconds / 4, [&] { agent.actor().forward(one, work); });

  const int width = options.critic_hidden.empty() ? 1 : options.critic_hidden.front();
  const Matrix a = Matrix::Random(width, width), b = Matrix::Random(width, options.batch);
  Matrix c(width, options.batch);
  const double product_s = time_of(seconds / 4, [&] { c.noalias() = a * b; });
  return {.updates_per_s = 1 / update_s,
          .actions_per_s = 1 / action_s,
          .update_flops = operations(options, states, actions) / update_s,
          .product_flops = 2.0 * width * width * options.batch / product_s};
}

template LearnerSpeed measure_learner<float>(const AgentOptions&, int, int, double);
template LearnerSpeed measure_learner<double>(const AgentOptions&, int, int, double);

}  // namespace stride::ddpg
