#pragma once

#include <filesystem>
#include <string>

#include "train/training/training.h"

namespace stride::training {

/// Stores a training in RUN/checkpoint.safetensors and RUN/replay/: first the decisions since the
/// last checkpoint as a new segment, then everything else atomically; then removes segments that
/// are no longer needed. A kill at any moment leaves a complete checkpoint, the old or the new one.
template <typename Scalar>
void save_checkpoint(const Training<Scalar>& training, const std::filesystem::path& run);

/// Restores a training with the same options from the checkpoint. Throws Error naming the file and
/// its defect; the training is then unusable.
template <typename Scalar>
void load_checkpoint(Training<Scalar>& training, const std::filesystem::path& run);

/// The state of a generator as it stands in a checkpoint.
std::string to_text(const Random& random);
/// Throws Error naming `file`, where the text was read, if it is no state.
Random random_from(const std::string& text, const std::string& file);

std::filesystem::path checkpoint_file(const std::filesystem::path& run);

}  // namespace stride::training
