#include "train/ppo/training.h"

#include <algorithm>
#include <array>
#include <span>

#include "train/ppo/exchange.h"

namespace stride::ppo {
namespace {

/// Streams of random numbers of a run.
enum Stream : std::uint64_t { kLearner = 1, kWeights = 2, kFirstSlot = 1000 };

}  // namespace

PpoTraining start_training(const training::TrainOptions& options, const Potential* potential,
                           const training::EnvironmentFactory& make_environment) {
  const std::unique_ptr<environment::Environment> example = make_environment(-1);
  const environment::EnvironmentSpec& spec = example->spec();
  const environment::Observer observer = training::make_observer(options, potential, spec);
  std::optional<environment::RightLegAhead> symmetry;
  environment::Mirror normalised = environment::mirror_by_name(observer.names());
  if (options.ppo.mirror) {
    symmetry = environment::right_leg_ahead(observer.names(), spec.action_names);
    normalised = environment::no_mirror(observer.names().size());  // right and left legs differ
  }
  const auto seed = static_cast<std::uint64_t>(options.run.seed);
  Random weights(stream_seed(seed, kWeights));
  PpoTraining training{.feature_names = observer.names(),
                       .action_names = spec.action_names,
                       .random = Random(stream_seed(seed, kLearner)),
                       .learner = Learner(options.ppo, static_cast<int>(observer.names().size()),
                                          static_cast<int>(spec.action_names.size()), weights),
                       .symmetry = symmetry,
                       .normaliser = network::Normaliser(normalised),
                       .slots = {},
                       .progress = {},
                       .sums = {}};
  for (int slot = 0; slot < options.run.environments; ++slot)
    training.slots.emplace_back(
        make_environment(slot), observer,
        Slot::Setup{.action_repeat = options.run.action_repeat,
                    .gamma = options.shaping.discounted ? options.ppo.gamma : 1,
                    .potential = potential,
                    .fall_reward = options.reward.fall},
        stream_seed(seed, kFirstSlot + static_cast<std::uint64_t>(slot)));
  return training;
}

network::Policy<float> policy_of(const PpoTraining& training) {
  network::MlpShape shape = training.learner.actor().shape();
  shape.output = network::Activation::sigmoid;
  network::Policy<float> policy{.actor = network::Mlp<float>(shape),
                                .normaliser = training.normaliser,
                                .symmetry = training.symmetry};
  policy.actor.parameters() = training.learner.actor().parameters();
  return policy;
}

void collect(const training::TrainOptions& options, PpoTraining& training,
             training::ThreadPool& threads, parallel::Ranks& ranks, RolloutBatch& batch) {
  const int n = options.run.environments, steps = options.ppo.horizon, samples = steps * n;
  const auto features = static_cast<Eigen::Index>(training.feature_names.size());
  const auto actions = static_cast<Eigen::Index>(training.action_names.size());
  batch.environments = n;
  batch.steps = steps;
  batch.states.resize(features, samples + n);
  batch.actions.resize(actions, samples);
  batch.logits.resize(actions, samples);
  batch.rewards.resize(samples);
  batch.ends.assign(static_cast<std::size_t>(samples), EpisodeEnd::none);
  batch.observed.resize(features, samples + n);
  batch.after.assign(static_cast<std::size_t>(samples), Matrix());

  const Options& ppo = options.ppo;
  const double age =
      std::min(1.0, static_cast<double>(training.progress.decisions) / ppo.alive_decisions);
  const double alive_per_s = ppo.alive_per_s + age * (ppo.final_alive_per_s - ppo.alive_per_s);

  threads.run((n + kGroup - 1) / kGroup, [&](int group) {
    if (!ranks.owns(group)) return;
    const int begin = group * kGroup, size = std::min(kGroup, n - begin);
    const std::span<Slot> slots =
        std::span(training.slots)
            .subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(size));
    network::Mlp<float>::Workspace work;
    Matrix states(features, size);
    std::array<const environment::Mirror*, kGroup> mirrors{};  // of each slot's next action
    Eigen::VectorXd seen(features);
    const auto view = [&](const Eigen::VectorXd& state) {
      const bool mirrored = training.symmetry && training.symmetry->mirrors(state);
      if (mirrored)
        training.symmetry->features.apply(state, seen);
      else
        seen = state;
      return mirrored ? &training.symmetry->actions : nullptr;
    };
    const auto see = [&](int first) {
      for (int i = 0; i < size; ++i) {
        mirrors[static_cast<std::size_t>(i)] = view(slots[static_cast<std::size_t>(i)].features());
        batch.observed.col(first + i) = seen;
      }
      states = batch.observed.middleCols(first, size).cast<float>();
      training.normaliser.apply(states);
      batch.states.middleCols(first, size) = states;
    };
    for (int t = 0; t < steps; ++t) {
      see(t * n + begin);
      const Matrix& logits = training.learner.actor().forward(states, work);
      for (int i = 0; i < size; ++i) {
        const int column = t * n + begin + i;
        Slot& slot = slots[static_cast<std::size_t>(i)];
        batch.logits.col(column) = logits.col(i);
        const auto [reward, end] =
            slot.decide(batch.logits.col(column), alive_per_s, batch.actions.col(column),
                        mirrors[static_cast<std::size_t>(i)]);
        batch.rewards[column] = reward;
        batch.ends[static_cast<std::size_t>(column)] = end;
        if (end == EpisodeEnd::truncated) {
          Matrix& state = batch.after[static_cast<std::size_t>(column)];
          view(slot.features());
          state = seen.cast<float>();
          training.normaliser.apply(state);
        }
        if (end != EpisodeEnd::none) slot.begin_next();
      }
    }
    see(steps * n + begin);
  });

  exchange_batch(ranks, kGroup, batch, training.slots);
  std::erase_if(batch.after, [](const Matrix& state) { return state.size() == 0; });
  batch.truncated_states.resize(features, static_cast<Eigen::Index>(batch.after.size()));
  for (std::size_t i = 0; i < batch.after.size(); ++i)
    batch.truncated_states.col(static_cast<Eigen::Index>(i)) = batch.after[i];
  for (Eigen::Index i = 0; i < steps * n; ++i) training.normaliser.add(batch.observed.col(i));
  training::Progress& progress = training.progress;
  progress.decisions += batch.decisions();
  for (Slot& slot : training.slots)
    for (const network::EpisodeSummary& episode : slot.take_finished()) progress.add(episode);
}

}  // namespace stride::ppo
