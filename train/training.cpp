#include "train/training.h"

#include <algorithm>
#include <cmath>

namespace stride {
namespace {

/// Streams of random numbers of a run.
enum Stream : std::uint64_t { kLearner = 1, kWeights = 2, kFirstSlot = 1000 };

/// Factors from 1/spread to spread over the slots, geometrically.
double spread_of(int slot, const TrainOptions& options) {
  if (options.run.environments == 1) return 1;
  return std::pow(options.exploration.spread, 2.0 * slot / (options.run.environments - 1) - 1);
}

}  // namespace

Observer make_observer(const TrainOptions& options, const Potential* potential,
                       const EnvironmentSpec& spec) {
  ObservationOptions observation = options.observation;
  if (potential == nullptr || potential->index == PotentialIndex::nearest)
    observation.phase = false;  // nothing depends on it
  std::optional<RobustFeatures> robust;
  if (observation.robust)
    robust.emplace(load_osim(model_file(options.environment)),
                   rules_named(options.environment.rules));
  return Observer(spec, observation, options.run.action_repeat * spec.step_s, std::move(robust));
}

template <typename Scalar>
Training<Scalar> start_training(const TrainOptions& options, const Potential* potential,
                                const EnvironmentFactory& make_environment) {
  const std::unique_ptr<Environment> example = make_environment(-1);
  const EnvironmentSpec& spec = example->spec();
  const Observer observer = make_observer(options, potential, spec);
  const Mirror feature_mirror = mirror_by_name(observer.names());
  const Mirror action_mirror = mirror_by_name(spec.action_names);
  const auto features = static_cast<int>(observer.names().size());
  const auto actions = static_cast<int>(spec.action_names.size());
  const auto seed = static_cast<std::uint64_t>(options.run.seed);

  Random weights(stream_seed(seed, kWeights));
  Training<Scalar> training{
      .feature_names = observer.names(),
      .action_names = spec.action_names,
      .step_s = spec.step_s,
      .random = Random(stream_seed(seed, kLearner)),
      .agent = Agent<Scalar>(options.agent, features, actions, weights),
      .normaliser = Normaliser(feature_mirror),
      .buffer = ReplayBuffer<Scalar>({.features = features,
                                      .actions = actions,
                                      .environments = options.run.environments,
                                      .capacity = options.replay.capacity,
                                      .lead = options.run.round},
                                     feature_mirror, action_mirror),
      .explorers = {},
      .progress = {}};
  for (int slot = 0; slot < options.run.environments; ++slot) {
    const typename Explorer<Scalar>::Setup setup{.exploration = options.exploration,
                                                 .action_repeat = options.run.action_repeat,
                                                 .spread = spread_of(slot, options),
                                                 .potential = potential,
                                                 .fall_reward = options.reward.fall,
                                                 .alive_reward_per_s = options.reward.alive_per_s};
    training.explorers.emplace_back(
        make_environment(slot), observer, setup,
        stream_seed(seed, kFirstSlot + static_cast<std::uint64_t>(slot)));
  }
  return training;
}

template <typename Scalar>
Policy<Scalar> policy_of(const Training<Scalar>& training, const TrainOptions& options) {
  const ExplorationOptions& noise = options.exploration;
  const double decayed =
      std::min(1.0, static_cast<double>(training.progress.decisions) / noise.decay_decisions);
  return {.actor = training.agent.actor(),
          .normaliser = training.normaliser,
          .sigma = noise.sigma + decayed * (noise.final_sigma - noise.sigma)};
}

template <typename Scalar>
double simulated_s(const Training<Scalar>& training) {
  double total = 0;
  for (const Explorer<Scalar>& explorer : training.explorers) total += explorer.state().simulated_s;
  return total;
}

template Training<float> start_training(const TrainOptions&, const Potential*,
                                        const EnvironmentFactory&);
template Training<double> start_training(const TrainOptions&, const Potential*,
                                         const EnvironmentFactory&);
template Policy<float> policy_of(const Training<float>&, const TrainOptions&);
template Policy<double> policy_of(const Training<double>&, const TrainOptions&);
template double simulated_s(const Training<float>&);
template double simulated_s(const Training<double>&);

}  // namespace stride
