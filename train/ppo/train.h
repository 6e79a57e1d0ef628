#pragma once

#include "train/training/train.h"

namespace stride::ppo {

/// What training::train() does, for a run whose run.learner is ppo. Its curve.csv has the columns
/// of the other learner's up to training_reward, then kl, entropy (nats), value_loss (of scaled
/// returns), explained_variance (means over the batches since the last row), and actor_rate.
training::TrainSummary train(const std::filesystem::path& run,
                             const training::EnvironmentFactory& make_environment,
                             const std::atomic<bool>& stop, std::FILE* messages,
                             parallel::Ranks& ranks = parallel::Ranks::alone());

}  // namespace stride::ppo
