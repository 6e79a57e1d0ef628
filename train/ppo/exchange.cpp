#include "train/ppo/exchange.h"

#include "extract/parallel/message.h"
#include "train/training/checkpoint.h"

namespace stride::ppo {
namespace {

using parallel::Message;

/// Calls visit(slot) for each slot of that rank.
template <typename Visit>
void each_slot(const parallel::Ranks& ranks, int rank, int group, std::size_t slots,
               const Visit& visit) {
  for (int slot = 0; slot < static_cast<int>(slots); ++slot)
    if (slot / group % ranks.size() == rank) visit(slot);
}

template <typename Derived>
void put(const Eigen::MatrixBase<Derived>& column, Message& message) {
  message.put(column.derived().data(), static_cast<std::size_t>(column.size()));
}
template <typename Column>
void get(Message& message, Column column) {
  message.get(column.data(), static_cast<std::size_t>(column.size()));
}

void put(const RolloutBatch& batch, int slot, Message& message) {
  for (int t = 0; t <= batch.steps; ++t) {
    const int column = t * batch.environments + slot;
    put(batch.states.col(column), message), put(batch.observed.col(column), message);
    if (t == batch.steps) break;
    put(batch.actions.col(column), message), put(batch.logits.col(column), message);
    message.put(batch.rewards[column]), message.put(batch.ends[static_cast<std::size_t>(column)]);
    put(batch.after[static_cast<std::size_t>(column)], message);
  }
}

void get(Message& message, int slot, RolloutBatch& batch) {
  for (int t = 0; t <= batch.steps; ++t) {
    const int column = t * batch.environments + slot;
    get(message, batch.states.col(column)), get(message, batch.observed.col(column));
    if (t == batch.steps) break;
    get(message, batch.actions.col(column)), get(message, batch.logits.col(column));
    message.get(&batch.rewards[column], 1);
    EpisodeEnd& end = batch.ends[static_cast<std::size_t>(column)];
    message.get(&end, 1);
    if (end != EpisodeEnd::truncated) continue;
    Matrix& after = batch.after[static_cast<std::size_t>(column)];
    after.resize(batch.states.rows(), 1);
    get(message, after.col(0));
  }
}

void put(const SlotState& state, Message& message) {
  message.put(training::to_text(state.random));
  message.put(state.running), message.put(state.episode_seed);
  message.put(state.actions.size()), message.put(state.actions.data(), state.actions.size());
  message.put(state.episode), message.put(state.simulated_s);
}

SlotState slot_state(Message& message) {
  SlotState state;
  state.random = training::random_from(message.get_text(), "the message of another rank");
  message.get(&state.running, 1), message.get(&state.episode_seed, 1);
  state.actions.resize(message.get<std::size_t>());
  message.get(state.actions.data(), state.actions.size());
  message.get(&state.episode, 1), message.get(&state.simulated_s, 1);
  return state;
}

}  // namespace

void exchange_batch(parallel::Ranks& ranks, int group, RolloutBatch& batch,
                    std::vector<Slot>& slots) {
  if (ranks.size() == 1) return;
  Message own;
  each_slot(ranks, ranks.rank(), group, slots.size(), [&](int slot) {
    put(batch, slot, own);
    const Slot& stepped = slots[static_cast<std::size_t>(slot)];
    own.put(stepped.state().simulated_s);
    own.put(stepped.finished().size());
    own.put(stepped.finished().data(), stepped.finished().size());
  });
  const std::vector<std::string> all = ranks.gather(own.bytes());
  for (int rank = 0; rank < ranks.size(); ++rank) {
    if (rank == ranks.rank()) continue;
    Message message(all[static_cast<std::size_t>(rank)]);
    each_slot(ranks, rank, group, slots.size(), [&](int slot) {
      get(message, slot, batch);
      const auto simulated_s = message.get<double>();
      std::vector<network::EpisodeSummary> finished(message.get<std::size_t>());
      message.get(finished.data(), finished.size());
      slots[static_cast<std::size_t>(slot)].take_over(simulated_s, std::move(finished));
    });
  }
}

training::Orders exchange_actor(parallel::Ranks& ranks, const training::Orders& orders,
                                Vector& actor) {
  if (ranks.size() == 1) return orders;
  Message own;
  if (ranks.first()) {
    own.put(orders.stop), own.put(orders.checkpoint), own.put(orders.divergence);
    put(actor, own);
  }
  Message first(ranks.gather(own.bytes())[0]);
  training::Orders agreed;
  first.get(&agreed.stop, 1), first.get(&agreed.checkpoint, 1);
  agreed.divergence = first.get_text();
  first.get(actor.data(), static_cast<std::size_t>(actor.size()));
  return agreed;
}

void collect_slots(parallel::Ranks& ranks, int group, std::vector<Slot>& slots) {
  if (ranks.size() == 1) return;
  Message own;
  each_slot(ranks, ranks.rank(), group, slots.size(),
            [&](int slot) { put(slots[static_cast<std::size_t>(slot)].state(), own); });
  const std::vector<std::string> all = ranks.gather(own.bytes());
  if (!ranks.first()) return;
  for (int rank = 1; rank < ranks.size(); ++rank) {
    Message message(all[static_cast<std::size_t>(rank)]);
    each_slot(ranks, rank, group, slots.size(), [&](int slot) {
      slots[static_cast<std::size_t>(slot)].take_over(slot_state(message));
    });
  }
}

}  // namespace stride::ppo
