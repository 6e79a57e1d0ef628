#pragma once

#include <filesystem>

#include "train/ddpg/replay_buffer.h"

namespace stride::training {

// The replay memory on disk: RUN/replay/FROM-TO.safetensors holds the records of the rounds from
// FROM to before TO, by round and environment: tensors features and actions (the bytes of the run's
// precision), outcome, reward, phase, pose, phi, phi_mirrored. Segments of version 1, whose records
// are the bytes of a struct, are read as well.

/// Writes the rounds that no segment has yet.
template <typename Scalar>
void save_new_segments(const ddpg::ReplayBuffer<Scalar>& buffer, const std::filesystem::path& run);

/// Reads the memory as it was after `rounds` rounds, and removes segments of later ones: they were
/// written before a kill. Rounds before the first kept one may be missing, none after it: throws
/// Error naming them.
template <typename Scalar>
void load_segments(ddpg::ReplayBuffer<Scalar>& buffer, const std::filesystem::path& run,
                   std::int64_t rounds);

/// Removes segments of which no record can be sampled any more.
template <typename Scalar>
void remove_old_segments(const ddpg::ReplayBuffer<Scalar>& buffer,
                         const std::filesystem::path& run);

}  // namespace stride::training
