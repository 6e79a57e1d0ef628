#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "train/training/options.h"

namespace stride::experiments {

/// What the runs of one arm of an experiment have in common: all but their seed.
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

/// Each `settings` (KEY=VALUE) holds in all arms that do not say otherwise. Throws Error naming
/// file, key and cure.
ExperimentFile load_experiment(const std::filesystem::path& file,
                               const std::vector<std::string>& settings = {});

}  // namespace stride::experiments
