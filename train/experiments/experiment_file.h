#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "train/experiments/plot.h"
#include "train/training/options.h"

namespace stride::experiments {

/// An arm of an experiment: everything but the seed of its runs.
struct ExperimentArm {
  std::string name;
  std::filesystem::path potential;  // empty: none
  std::filesystem::path curves;     // of another experiment's arm that has the same settings
  training::TrainOptions train;
};

/// What an experiment tests: that one arm comes farther than another.
struct ExperimentClaim {
  std::string text;          // empty: none
  std::string better, than;  // arms
  double at = 1;             // share of the decisions, one of kBudgetShares
};

/// train/results/NAME/experiment.toml:
///
///     title = "Baseline against shaping"
///     preset = "shaping"        # of every arm
///     decisions = 800000        # of each run
///     seeds = 5                 # so many, the same in each arm
///     first_seed = 101          # 1 if not given, as the seven that follow may be missing
///     claim = "twice as far at half of the training"
///     better = "nearest"        # the last arm if not given
///     than = "baseline"         # the first arm if not given
///     at = 0.5                  # of the decisions: 0.1, 0.2, 0.3, 0.5 or 1, which is usual
///     clip = "../human.calibrated.csv"        # whose gait the arms' are compared with
///     level = 11.2              # m, drawn as a line
///     level_label = "the demonstration"
///
///     [baseline]                # the arm that the others are compared with is the first
///     potential = ""            # none
///
///     [nearest]
///     potential = "../human.potential.json"   # from this file's folder
///     shaping.index = "nearest"               # any setting of config.toml
///     curves = "../ways/human-nearest"        # instead of training seeds that are there, unless
///                                             # the command line sets something else
struct ExperimentFile {
  std::string title, preset;
  std::int64_t decisions = 0;
  int seeds = 5, first_seed = 1;
  ExperimentClaim claim;
  std::filesystem::path clip;  // empty: none
  Level level;
  std::vector<ExperimentArm> arms;  // in the order of the file

  /// What the agents of all arms are to do.
  const task::TaskOptions& task() const {
    static const task::TaskOptions kRun;
    return arms.empty() ? kRun : arms.front().train.environment.task;
  }

  /// What the arms' curves are drawn against: "decisions", or "simulated" if they have other
  /// budgets.
  std::string against() const {
    for (const ExperimentArm& arm : arms)
      if (arm.train.run.decisions != decisions) return "simulated";
    return "decisions";
  }
};

/// NAME, as baseline-vs-shaping or figures/mirrored, or the path of an experiment.toml or its
/// folder. Throws Error with the list of experiments.
std::filesystem::path experiment_file(const std::string& name);

/// The files of all experiments of a group: of "figures/all" those in train/results/figures. Empty
/// if the name is no group's.
std::vector<std::filesystem::path> experiment_group(const std::string& name);

/// Each of `settings` (KEY=VALUE) applies to all arms that do not set the key themselves. Throws
/// Error naming file, key and cure.
ExperimentFile load_experiment(const std::filesystem::path& file,
                               const std::vector<std::string>& settings = {});

}  // namespace stride::experiments
