#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "train/rollout/gait.h"
#include "train/training/options.h"

namespace stride::evaluation {

struct EvaluateOptions {
  int episodes = 1;            // seeds 0, 1, …; the film shows the one with the largest distance
  std::string agent = "best";  // best.safetensors, or agent: the last one
  int difficulty = -1;         // -1: as in training
  std::string rules, engine;   // empty: as in training
  std::filesystem::path out;   // folder of what is written; empty: the run folder
  bool film = true;
  std::filesystem::path trajectory;  // if not empty: a demonstration of the best episode goes there
  double from_s = 2;                 // where the demonstration begins
};

struct Evaluation {
  std::vector<network::EpisodeSummary> episodes;
  double distance_m = 0, distance_se_m = 0;  // mean and standard error
  int falls = 0;
  rollout::GaitSummary gait;  // of the episode with the largest distance
  std::filesystem::path file;
  std::string brief_report() const;
};

/// Runs the agent of a run folder without noise. Writes evaluation.json (format
/// "stride-evaluation" version 1), evaluation.mot, evaluation.sto and evaluation.mp4. Needs of the
/// run folder config.toml, the policy, and the potential if it has one. Errors name the file.
Evaluation evaluate(const std::filesystem::path& run, const EvaluateOptions& options);

}  // namespace stride::evaluation
