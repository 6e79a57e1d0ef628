#pragma once

#include <filesystem>
#include <vector>

#include "train/normaliser.h"
#include "train/ppo/learner.h"
#include "train/ppo/slot.h"
#include "train/training.h"

namespace stride::ppo {

/// Counters of a run, and sums since the last row of the curve.
struct Progress {
  std::int64_t decisions = 0, updates = 0, episodes = 0, falls = 0, failures = 0;
  std::int64_t rows = 0;             // of curve.csv
  std::int64_t next_evaluation = 0;  // in decisions
  double best_distance_m = -1e300;   // of an evaluation
  struct Sums {
    double episodes = 0, distance_m = 0, reward = 0;
    double batches = 0, kl = 0, entropy = 0, value_loss = 0, explained_variance = 0;
  } sums;
};

/// Everything that changes while a run goes on.
struct Training {
  std::vector<std::string> feature_names, action_names;
  Random random;  // of the learner
  Learner learner;
  Normaliser normaliser;
  std::vector<Slot> slots;
  Progress progress;
};

/// The beginning of a run. `potential` may be null, and must outlive the training.
Training start_training(const TrainOptions& options, const Potential* potential,
                        const EnvironmentFactory& make_environment);

/// The agent without chance: each excitation is the probability that training would draw a 1 with.
Policy<float> policy_of(const Training& training);

/// Makes `horizon` decisions in every environment by the policy of the moment.
void collect(const TrainOptions& options, Training& training, Crew& crew, RolloutBatch& batch);

/// RUN/checkpoint.safetensors, written atomically.
void save_checkpoint(const Training& training, const std::filesystem::path& run);
/// Throws Error naming the file and what is wrong with it.
void load_checkpoint(Training& training, const std::filesystem::path& run);

}  // namespace stride::ppo
