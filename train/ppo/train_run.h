#pragma once

#include "extract/parallel/ranks.h"
#include "train/training/train.h"

namespace stride {

/// Trains the run in that folder as training::train() does, by the learner that its configuration
/// names. PPO runs on one rank: with more, throws Error.
training::TrainSummary train_run(const std::filesystem::path& run,
                                 const training::EnvironmentFactory& make_environment,
                                 const std::atomic<bool>& stop, std::FILE* messages,
                                 parallel::Ranks& ranks = parallel::Ranks::alone());

}  // namespace stride
