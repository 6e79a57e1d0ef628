#pragma once

#include <string>

#include "extract/parallel/ranks.h"
#include "train/training/training.h"

namespace stride::training {

/// How the ranks of mpirun share a training. The first rank learns, evaluates and writes the run
/// folder; the others explore, each in the slots that it owns. Every rank keeps the whole replay
/// memory, the normaliser and the counters, and after each round all of them are told what each has
/// added: so the curve is that of one rank, byte by byte. With one rank nothing is sent.
///
/// A round sends each rank the new records, of 4 · (features + actions) + 112 bytes in single
/// precision, and the parameters of the actor.
bool explores(const parallel::Ranks& ranks, int slot);

/// What the first rank decides for all.
struct Orders {
  bool stop = false;
  bool checkpoint = false;
  std::string divergence;  // why learning was stopped; empty: it was not
};

/// After a round, before its records join the memory: brings records, ended episodes and the new
/// actor to all ranks. `orders` are those of this rank; returns those of the first.
template <typename Scalar>
Orders exchange_round(const TrainOptions& options, const Orders& orders, parallel::Ranks& ranks,
                      Training<Scalar>& training);

/// Brings the state of every slot to the first rank, for a checkpoint.
template <typename Scalar>
void collect_explorers(parallel::Ranks& ranks, Training<Scalar>& training);

}  // namespace stride::training
