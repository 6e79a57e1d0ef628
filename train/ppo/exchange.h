#pragma once

#include "extract/parallel/ranks.h"
#include "train/ppo/rollout_batch.h"
#include "train/ppo/slot.h"
#include "train/training/exchange.h"

namespace stride::ppo {

/// How the ranks of mpirun share a training. A rank steps the groups of slots that it owns, and
/// brings what they collected to all; the first learns from it, evaluates and writes the run
/// folder. Every rank keeps the normaliser and the counters: so the curve is that of one rank, byte
/// by byte. With one rank nothing is sent.

/// After a batch: brings the columns of each rank's slots, and the episodes that ended, to all.
/// Group g has the slots from g · `group`.
void exchange_batch(parallel::Ranks& ranks, int group, RolloutBatch& batch,
                    std::vector<Slot>& slots);

/// After learning: brings the first rank's actor and orders to all.
training::Orders exchange_actor(parallel::Ranks& ranks, const training::Orders& orders,
                                Vector& actor);

/// Brings the state of every slot to the first rank, for a checkpoint.
void collect_slots(parallel::Ranks& ranks, int group, std::vector<Slot>& slots);

}  // namespace stride::ppo
