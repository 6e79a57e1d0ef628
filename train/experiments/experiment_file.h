#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "train/training/options.h"

namespace stride::experiments {

/// An arm of an experiment: everything but the seed of its runs.
struct ExperimentArm {
  std::string name;
  std::filesystem::path potential;  // empty: none
  training::TrainOptions train;
};

/// train/results/NAME/experiment.toml:
///
///     title = "Baseline against shaping"
///     preset = "shaping"        # of every arm
///     decisions = 800000        # of each run
///     seeds = 5                 # 1, 2, …, the same in each arm
///
///     [baseline]                # the arm that the others are compared with is the first
///     potential = ""            # none
///
///     [nearest]
///     potential = "../human.potential.json"   # from this file's folder
///     shaping.index = "nearest"               # any setting of config.toml
struct ExperimentFile {
  std::string title, preset;
  std::int64_t decisions = 0;
  int seeds = 5;
  std::vector<ExperimentArm> arms;  // in the order of the file
};

/// NAME, or the path of an experiment.toml. Throws Error with the list of experiments.
std::filesystem::path experiment_file(const std::string& name);

/// Each of `settings` (KEY=VALUE) applies to all arms that do not set the key themselves. Throws
/// Error naming file, key and cure.
ExperimentFile load_experiment(const std::filesystem::path& file,
                               const std::vector<std::string>& settings = {});

}  // namespace stride::experiments
