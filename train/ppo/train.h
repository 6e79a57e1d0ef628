#pragma once

#include "train/train.h"

namespace stride::ppo {

/// What stride::train() does for a run whose run.learner is "ppo". Its curve.csv has the columns of
/// the other learner's up to training_reward, then kl, entropy (nats), value_loss (of scaled
/// returns), explained_variance (means over the batches since the last row) and actor_rate.
TrainSummary train(const TrainOptions& options, const Potential* potential,
                   const std::filesystem::path& run, const EnvironmentFactory& make_environment,
                   const std::atomic<bool>& stop, std::FILE* messages);

}  // namespace stride::ppo
