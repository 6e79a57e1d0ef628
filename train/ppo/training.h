#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "extract/parallel/ranks.h"
#include "train/network/normaliser.h"
#include "train/ppo/learner.h"
#include "train/ppo/slot.h"
#include "train/training/training.h"

namespace stride::ppo {

/// Of the batches since the last row of the curve.
struct BatchSums {
  double batches = 0, kl = 0, entropy = 0, value_loss = 0, explained_variance = 0;
};

/// Everything that changes while a run goes on.
struct PpoTraining {
  std::vector<std::string> feature_names, action_names;
  Random random;  // of the learner
  Learner learner;
  /// With ppo.mirror: states, normaliser and actions are those of the agent's view.
  std::optional<environment::RightLegAhead> symmetry;
  network::Normaliser normaliser;
  std::vector<Slot> slots;
  training::Progress progress;
  BatchSums sums;
};

/// Starts a run. `potential` may be null and must outlive the training.
PpoTraining start_training(const training::TrainOptions& options, const Potential* potential,
                           const training::EnvironmentFactory& make_environment);

/// The agent without chance: each excitation is the probability that training would draw a 1 with.
network::Policy<float> policy_of(const PpoTraining& training);

/// Slots share a product of matrices, and a rank, in groups of this size, whatever the threads.
inline constexpr int kGroup = 8;

/// Makes `horizon` decisions in every environment by the policy of the moment; `ranks` share them.
void collect(const training::TrainOptions& options, PpoTraining& training,
             training::ThreadPool& threads, parallel::Ranks& ranks, RolloutBatch& batch);

/// RUN/checkpoint.safetensors, written atomically.
void save_checkpoint(const PpoTraining& training, const std::filesystem::path& run);
/// Throws Error naming the file and what is wrong with it.
void load_checkpoint(PpoTraining& training, const std::filesystem::path& run);
/// Of a checkpoint of another run the policy, the critic, what steers them, and the normaliser. All
/// else is as at the beginning of a run. Throws Error likewise.
void begin_with(PpoTraining& training, const std::filesystem::path& checkpoint);

}  // namespace stride::ppo
