#pragma once

#include <filesystem>

#include "train/training/training.h"

namespace stride::training {

/// Stores a training in RUN/checkpoint.safetensors and RUN/replay/: the decisions since the last
/// checkpoint as a new segment, then everything else, atomically; last, segments that nothing needs
/// any more are removed. A kill at any moment leaves the old checkpoint or the new one whole.
template <typename Scalar>
void save_checkpoint(const Training<Scalar>& training, const std::filesystem::path& run);

/// Puts a training that was started with the same options where the checkpoint was. Throws Error
/// naming the file and what is wrong with it; then the training is in no usable state.
template <typename Scalar>
void load_checkpoint(Training<Scalar>& training, const std::filesystem::path& run);

std::filesystem::path checkpoint_file(const std::filesystem::path& run);

}  // namespace stride::training
