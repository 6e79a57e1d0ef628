#include "train/ppo/learner.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stride::ppo {
namespace {

/// A minibatch is worked on in so many parts, whose gradients are added in order: the sums do not
/// depend on the number of threads.
constexpr int kParts = 2;
constexpr double kSlowestRate = 1e-6, kFastestRate = 3e-3;
constexpr float kLargestLogRatio = 10;  // e¹⁰: far beyond the clip

network::MlpShape shape(const std::vector<int>& hidden, const std::string& activations, int inputs,
                        int outputs) {
  return {.inputs = inputs,
          .outputs = outputs,
          .hidden = hidden,
          .activation = network::activation(activations)};
}

network::Adam<float> adam(const Options& options) {
  return {.options = {.epsilon = 1e-5, .gradient_norm_limit = options.gradient_norm_limit}};
}

/// From `first` to `last` as `age` goes from 0 to 1.
double annealed(double first, double last, double age) { return first + age * (last - first); }

/// Columns of a batch, gathered, and what a part of a minibatch adds to the gradients.
struct Part {
  Matrix states, actions, logits;
  Vector log_probabilities, advantages, targets;  // targets of the critic, scaled
  network::Mlp<float>::Workspace actor_work, critic_work;
  Vector actor_gradient, critic_gradient;
  double kl = 0, entropy = 0, value_loss = 0;  // sums over the columns

  void gather(const RolloutBatch& batch, const Vector& scaled_returns, const int* columns, int n) {
    states.resize(batch.states.rows(), n);
    actions.resize(batch.actions.rows(), n);
    logits.resize(batch.logits.rows(), n);
    log_probabilities.resize(n), advantages.resize(n), targets.resize(n);
    for (int i = 0; i < n; ++i) {
      const int column = columns[i];
      states.col(i) = batch.states.col(column);
      actions.col(i) = batch.actions.col(column);
      logits.col(i) = batch.logits.col(column);
      log_probabilities[i] = batch.log_probabilities[column];
      advantages[i] = batch.advantages[column];
      targets[i] = scaled_returns[column];
    }
  }

  /// The gradient of −mean(min(r A, clip(r) A)) − weight · mean(entropy), r the ratio of the
  /// action's probabilities now and when it was drawn; `count` columns are in the mean.
  void descend_actor(const network::Mlp<float>& actor, float clip, float entropy_weight,
                     int count) {
    const Matrix& z = actor.forward(states, actor_work);
    const Eigen::ArrayXf ratio = (log_probability(z, actions) - log_probabilities)
                                     .array()
                                     .max(-kLargestLogRatio)
                                     .min(kLargestLogRatio)
                                     .exp();
    const Eigen::ArrayXf a = advantages.array();
    const auto clipped = (a > 0 && ratio > 1 + clip) || (a < 0 && ratio < 1 - clip);
    const Eigen::ArrayXf slope = clipped.select(0.0f, ratio * a);
    const float scale = -1.0f / static_cast<float>(count);
    Matrix gradient = log_probability_gradient(z, actions);
    gradient.array().rowwise() *= (scale * slope).transpose();
    gradient += (scale * entropy_weight) * entropy_gradient(z);
    kl = divergence(logits, z).cast<double>().sum();
    entropy = ppo::entropy(z).cast<double>().sum();
    actor.backward(states, gradient, actor_work, &actor_gradient, false);
  }

  /// The gradient of mean(½ (net − target)²).
  void descend_critic(const network::Mlp<float>& critic, int count) {
    const Matrix error = critic.forward(states, critic_work) - targets.transpose();
    value_loss = 0.5 * static_cast<double>(error.squaredNorm());
    critic.backward(states, error / static_cast<float>(count), critic_work, &critic_gradient,
                    false);
  }
};

/// 1: the values explain the returns; 0: no better than a constant.
double explained_variance(const RolloutBatch& batch) {
  const auto n = batch.decisions();
  const Eigen::ArrayXd returns = batch.returns.cast<double>();
  const Eigen::ArrayXd errors = returns - batch.values.head(n).cast<double>().array();
  const double variance = (returns - returns.mean()).square().mean();
  return variance > 0 ? 1 - (errors - errors.mean()).square().mean() / variance : 0;
}

}  // namespace

Learner::Learner(const Options& options, int features, int actions, Random& weights)
    : options_(options),
      actor_(shape(options.actor_hidden, options.activation, features, actions)),
      actor_adam_(adam(options)),
      critic_{
          .net = network::Mlp<float>(shape(options.critic_hidden, options.activation, features, 1)),
          .adam = adam(options)},
      rate_(options.rate) {
  actor_.initialise(weights, 0.01);
  critic_.net.initialise(weights, 0.1);
}

void Learner::assess(training::ThreadPool& threads, RolloutBatch& batch) {
  const Eigen::Index n = batch.decisions();
  batch.log_probabilities = log_probability(batch.logits, batch.actions);
  batch.values.resize(batch.states.cols());
  threads.run(kParts, [&](int part) {
    const Eigen::Index begin = batch.states.cols() * part / kParts;
    const Eigen::Index end = batch.states.cols() * (part + 1) / kParts;
    network::Mlp<float>::Workspace work;
    batch.values.segment(begin, end - begin) =
        critic_.values(batch.states.middleCols(begin, end - begin), work);
  });
  batch.truncated_values.resize(batch.truncated_states.cols());
  if (batch.truncated_states.cols() > 0) {
    network::Mlp<float>::Workspace work;
    batch.truncated_values = critic_.values(batch.truncated_states, work);
  }
  estimate_advantages(options_.gamma, options_.lambda, batch);
  critic_.rescale(batch.returns);
  const float mean = batch.advantages.mean();
  batch.advantages.array() -= mean;
  batch.advantages /= std::sqrt(batch.advantages.squaredNorm() / static_cast<float>(n)) + 1e-6f;
}

UpdateReport Learner::update(const RolloutBatch& batch, double age, Random& random,
                             training::ThreadPool& threads) {
  const int n = batch.decisions(), minibatch = std::min(options_.minibatch, n);
  const auto clip = static_cast<float>(options_.clip);
  const auto weight = static_cast<float>(annealed(options_.entropy, options_.final_entropy, age));
  const double wanted_kl = annealed(options_.kl, options_.final_kl, age);
  const double critic_rate = options_.rate * annealed(1, options_.final_rate, age);
  const Vector targets = critic_.scaled(batch.returns);

  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::vector<Part> parts(kParts);
  UpdateReport report;
  for (int pass = 0; pass < options_.epochs; ++pass) {
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[uniform_index(random, i)]);
    report = {.steps = report.steps};
    int seen = 0, steps = 0;
    for (int begin = 0; begin + minibatch <= n; begin += minibatch, ++steps) {
      threads.run(kParts, [&](int i) {
        const int from = begin + minibatch * i / kParts, to = begin + minibatch * (i + 1) / kParts;
        Part& part = parts[static_cast<std::size_t>(i)];
        part.gather(batch, targets, order.data() + from, to - from);
        part.descend_actor(actor_, clip, weight, minibatch);
        part.descend_critic(critic_.net, minibatch);
      });
      Part& sum = parts.front();
      for (std::size_t i = 1; i < parts.size(); ++i) {
        sum.actor_gradient += parts[i].actor_gradient;
        sum.critic_gradient += parts[i].critic_gradient;
      }
      for (const Part& part : parts) {
        report.kl += part.kl;
        report.entropy += part.entropy;
        report.value_loss += part.value_loss;
      }
      seen += minibatch;
      report.actor_gradient += actor_adam_.descend(actor_.parameters(), sum.actor_gradient, rate_);
      report.critic_gradient +=
          critic_.adam.descend(critic_.net.parameters(), sum.critic_gradient, critic_rate);
    }
    report.steps += steps;
    report.kl /= seen, report.entropy /= seen, report.value_loss /= seen;
    report.actor_gradient /= steps, report.critic_gradient /= steps;
    if (report.kl > 2 * wanted_kl) break;
  }
  report.explained_variance = explained_variance(batch);
  // The divergence grows with the square of the rate.
  rate_ *= std::clamp(std::sqrt(wanted_kl / std::max(report.kl, 1e-9)), 0.7, 1.2);
  rate_ = std::clamp(rate_, kSlowestRate, kFastestRate);
  return report;
}

}  // namespace stride::ppo
