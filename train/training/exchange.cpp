#include "train/training/exchange.h"

#include <sstream>

#include "extract/parallel/message.h"

namespace stride::training {
namespace {

using parallel::Message;

int owner(const parallel::Ranks& ranks, int slot) {
  return ranks.size() == 1 ? 0 : 1 + slot % (ranks.size() - 1);
}

/// Calls visit(slot) for each slot of that rank.
template <typename Visit>
void each_slot(const parallel::Ranks& ranks, int rank, int slots, const Visit& visit) {
  for (int slot = 0; slot < slots; ++slot)
    if (owner(ranks, slot) == rank) visit(slot);
}

template <typename Scalar>
void put_slot(const Training<Scalar>& training, int rounds, int slot, Message& message) {
  const auto& buffer = training.buffer;
  for (std::int64_t round = buffer.rounds(); round < buffer.rounds() + rounds; ++round) {
    message.put(buffer.record(round, slot));
    message.put(buffer.features(round, slot).data(), std::size_t(buffer.layout().features));
    message.put(buffer.action(round, slot).data(), std::size_t(buffer.layout().actions));
  }
  const auto& explorer = training.explorers[static_cast<std::size_t>(slot)];
  message.put(explorer.state().simulated_s);
  message.put(explorer.finished().size());
  message.put(explorer.finished().data(), explorer.finished().size());
}

template <typename Scalar>
void get_slot(Message& message, int rounds, int slot, Training<Scalar>& training) {
  auto& buffer = training.buffer;
  for (std::int64_t round = buffer.rounds(); round < buffer.rounds() + rounds; ++round) {
    message.get(&buffer.record(round, slot), 1);
    message.get(buffer.features(round, slot).data(), std::size_t(buffer.layout().features));
    message.get(buffer.action(round, slot).data(), std::size_t(buffer.layout().actions));
  }
  const auto simulated_s = message.get<double>();
  std::vector<network::EpisodeSummary> finished(message.get<std::size_t>());
  message.get(finished.data(), finished.size());
  training.explorers[static_cast<std::size_t>(slot)].take_over(simulated_s, std::move(finished));
}

template <typename Scalar>
void put_state(const ddpg::ExplorerState<Scalar>& state, Message& message) {
  std::ostringstream random;
  random << state.random;
  message.put(random.str());
  message.put(state.running), message.put(state.over), message.put(state.episode_seed);
  message.put(state.actions.size()), message.put(state.actions.data(), state.actions.size());
  message.put(state.sigma_factor);
  message.put(state.noise.x.data(), static_cast<std::size_t>(state.noise.x.size()));
  message.put(state.perturbed.size());
  message.put(state.perturbed.data(), static_cast<std::size_t>(state.perturbed.size()));
  message.put(state.episode), message.put(state.simulated_s);
}

template <typename Scalar>
void get_state(Message& message, ddpg::ExplorerState<Scalar>& state) {
  std::istringstream random(message.get_text());
  random >> state.random;
  message.get(&state.running, 1), message.get(&state.over, 1), message.get(&state.episode_seed, 1);
  state.actions.resize(message.get<std::size_t>());
  message.get(state.actions.data(), state.actions.size());
  message.get(&state.sigma_factor, 1);
  message.get(state.noise.x.data(), static_cast<std::size_t>(state.noise.x.size()));
  state.perturbed.resize(message.get<Eigen::Index>());
  message.get(state.perturbed.data(), static_cast<std::size_t>(state.perturbed.size()));
  message.get(&state.episode, 1), message.get(&state.simulated_s, 1);
}

}  // namespace

bool explores(const parallel::Ranks& ranks, int slot) { return owner(ranks, slot) == ranks.rank(); }

template <typename Scalar>
Orders exchange_round(const TrainOptions& options, const Orders& orders, parallel::Ranks& ranks,
                      Training<Scalar>& training) {
  if (ranks.size() == 1) return orders;
  const int slots = options.run.environments, rounds = options.run.round;
  auto& actor = training.agent.actor().parameters();
  const auto actor_size = static_cast<std::size_t>(actor.size());
  Message own;
  if (ranks.first()) {
    own.put(orders.stop), own.put(orders.checkpoint), own.put(orders.divergence);
    own.put(actor.data(), actor_size);
  }
  each_slot(ranks, ranks.rank(), slots, [&](int slot) { put_slot(training, rounds, slot, own); });
  const std::vector<std::string> all = ranks.gather(own.bytes());
  Message first(all[0]);
  Orders agreed;
  first.get(&agreed.stop, 1), first.get(&agreed.checkpoint, 1);
  agreed.divergence = first.get_text();
  first.get(actor.data(), actor_size);
  for (int rank = 1; rank < ranks.size(); ++rank) {
    if (rank == ranks.rank()) continue;
    Message message(all[static_cast<std::size_t>(rank)]);
    each_slot(ranks, rank, slots, [&](int slot) { get_slot(message, rounds, slot, training); });
  }
  return agreed;
}

template <typename Scalar>
void collect_explorers(parallel::Ranks& ranks, Training<Scalar>& training) {
  if (ranks.size() == 1) return;
  const int slots = static_cast<int>(training.explorers.size());
  Message own;
  each_slot(ranks, ranks.rank(), slots, [&](int slot) {
    put_state(training.explorers[static_cast<std::size_t>(slot)].state(), own);
  });
  const std::vector<std::string> all = ranks.gather(own.bytes());
  if (!ranks.first()) return;
  for (int rank = 1; rank < ranks.size(); ++rank) {
    Message message(all[static_cast<std::size_t>(rank)]);
    each_slot(ranks, rank, slots, [&](int slot) {
      auto& explorer = training.explorers[static_cast<std::size_t>(slot)];
      ddpg::ExplorerState<Scalar> state = explorer.state();
      get_state(message, state);
      explorer.take_over(state);
    });
  }
}

template Orders exchange_round(const TrainOptions&, const Orders&, parallel::Ranks&,
                               Training<float>&);
template Orders exchange_round(const TrainOptions&, const Orders&, parallel::Ranks&,
                               Training<double>&);
template void collect_explorers(parallel::Ranks&, Training<float>&);
template void collect_explorers(parallel::Ranks&, Training<double>&);

}  // namespace stride::training
