#include "train/training/training.h"

#include <algorithm>
#include <cmath>

namespace stride::training {
namespace {

/// Streams of random numbers of a run.
enum Stream : std::uint64_t { kLearner = 1, kWeights = 2, kFirstSlot = 1000 };

/// Factors from 1/sigma_ratio to sigma_ratio over the slots, geometrically.
double sigma_factor_of(int slot, const TrainOptions& options) {
  if (options.run.environments == 1) return 1;
  return std::pow(options.exploration.sigma_ratio, 2.0 * slot / (options.run.environments - 1) - 1);
}

}  // namespace

environment::Observer make_observer(const TrainOptions& options, const Potential* potential,
                                    const environment::EnvironmentSpec& spec) {
  environment::ObservationOptions observation = options.observation;
  if (potential == nullptr || potential->index == PotentialIndex::nearest)
    observation.phase = false;  // nothing depends on it
  else if (!potential->repeats)
    observation.phase_as = environment::PhaseAs::passage;
  else if (potential->mirrored_after == 0)
    observation.phase_as = environment::PhaseAs::cycle;
  return environment::Observer(spec, observation, options.run.action_repeat * spec.step_s);
}

void Progress::add(const network::EpisodeSummary& episode) {
  ++episodes;
  falls += episode.fell;
  failures += episode.failed;
  sums.episodes += 1;
  sums.distance_m += episode.distance_m;
  sums.reward += episode.reward;
}

template <typename Scalar>
Training<Scalar> start_training(const TrainOptions& options, const Potential* potential,
                                const EnvironmentFactory& make_environment) {
  const std::unique_ptr<environment::Environment> example = make_environment(-1);
  const environment::EnvironmentSpec& spec = example->spec();
  const environment::Observer observer = make_observer(options, potential, spec);
  const environment::Mirror feature_mirror = environment::mirror_by_name(observer.names());
  const environment::Mirror action_mirror = environment::mirror_by_name(spec.action_names);
  const auto features = static_cast<int>(observer.names().size());
  const auto actions = static_cast<int>(spec.action_names.size());
  const auto seed = static_cast<std::uint64_t>(options.run.seed);

  Random weights(stream_seed(seed, kWeights));
  Training<Scalar> training{
      .feature_names = observer.names(),
      .action_names = spec.action_names,
      .step_s = spec.step_s,
      .random = Random(stream_seed(seed, kLearner)),
      .agent = ddpg::Agent<Scalar>(options.agent, features, actions, weights),
      .normaliser = network::Normaliser(feature_mirror),
      .buffer = ddpg::ReplayBuffer<Scalar>({.features = features,
                                            .actions = actions,
                                            .environments = options.run.environments,
                                            .capacity = options.replay.capacity,
                                            .lead = options.run.round},
                                           feature_mirror, action_mirror),
      .explorers = {},
      .progress = {}};
  for (int slot = 0; slot < options.run.environments; ++slot) {
    const typename ddpg::Explorer<Scalar>::Setup setup{
        .exploration = options.exploration,
        .action_repeat = options.run.action_repeat,
        .sigma_factor = sigma_factor_of(slot, options),
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
network::Policy<Scalar> policy_of(const Training<Scalar>& training, const TrainOptions& options) {
  const ddpg::ExplorationOptions& noise = options.exploration;
  const double decayed =
      std::min(1.0, static_cast<double>(training.progress.decisions) / noise.decay_decisions);
  return {.actor = training.agent.actor(),
          .normaliser = training.normaliser,
          .sigma = noise.sigma + decayed * (noise.final_sigma - noise.sigma)};
}

template <typename Scalar>
double simulated_s(const Training<Scalar>& training) {
  double total = 0;
  for (const ddpg::Explorer<Scalar>& explorer : training.explorers)
    total += explorer.state().simulated_s;
  return total;
}

Evaluator::Evaluator(const TrainOptions& options, const Potential* potential,
                     const EnvironmentFactory& make_environment, int threads)
    : options_(options), potential_(potential) {
  for (int i = 0; i < std::min(threads, options.run.evaluation_episodes); ++i) {
    environments_.push_back(make_environment(-1));
    observers_.push_back(make_observer(options, potential, environments_.back()->spec()));
  }
}

template <typename Scalar>
std::vector<network::EpisodeSummary> Evaluator::evaluate(const network::Policy<Scalar>& policy,
                                                         ThreadPool& threads) {
  std::vector<network::EpisodeSummary> episodes(
      static_cast<std::size_t>(options_.run.evaluation_episodes));
  const std::size_t lanes = environments_.size();
  threads.run(static_cast<int>(lanes), [&](int task) {
    const auto lane = static_cast<std::size_t>(task);
    for (std::size_t i = lane; i < episodes.size(); i += lanes)
      episodes[i] = network::run_episode(policy, *environments_[lane], observers_[lane], potential_,
                                         options_.run.action_repeat, i, nullptr);
  });
  return episodes;
}

template Training<float> start_training(const TrainOptions&, const Potential*,
                                        const EnvironmentFactory&);
template Training<double> start_training(const TrainOptions&, const Potential*,
                                         const EnvironmentFactory&);
template network::Policy<float> policy_of(const Training<float>&, const TrainOptions&);
template network::Policy<double> policy_of(const Training<double>&, const TrainOptions&);
template double simulated_s(const Training<float>&);
template double simulated_s(const Training<double>&);
template std::vector<network::EpisodeSummary> Evaluator::evaluate(const network::Policy<float>&,
                                                                  ThreadPool&);
template std::vector<network::EpisodeSummary> Evaluator::evaluate(const network::Policy<double>&,
                                                                  ThreadPool&);

}  // namespace stride::training
