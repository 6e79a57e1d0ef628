#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "train/evaluation/episodes.h"
#include "train/rollout/clip_similarity.h"
#include "train/rollout/gait_summary.h"
#include "train/training/options.h"

namespace stride::evaluation {

struct EvaluateOptions {
  int episodes = 1;             // the film shows the one with the median distance
  std::int64_t first_seed = 0;  // of the episodes: first_seed, first_seed + 1, …
  int threads = 0;              // 0: one a core
  int obstacles = -1;           // -1: as many as in training
  std::string agent = "best";   // best.safetensors, or agent: the last one
  int difficulty = -1;          // -1: as in training
  std::string rules, engine;    // empty: as in training
  std::filesystem::path out;    // folder of what is written; empty: the run folder
  bool film = true;
  std::filesystem::path
      trajectory;              // if not empty: a demonstration of the median episode goes there
  double from_s = 2;           // where the demonstration begins
  std::filesystem::path clip;  // NAME.calibrated.csv to compare the gait with; empty: none
};

struct Evaluation {
  std::vector<network::EpisodeSummary> episodes;
  std::uint64_t first_seed = 0;
  EpisodeStatistics statistics;
  rollout::GaitSummary gait;                          // of the median episode
  std::optional<rollout::ClipSimilarity> similarity;  // of that to options.clip
  task::TaskOptions task;                             // of the agent: the distances are its measure
  std::filesystem::path file;
  std::string brief_report() const;
};

/// Runs the agent of a run folder without noise. Writes evaluation.json (format
/// "stride-evaluation" version 1), evaluation.mot, evaluation.sto and evaluation.mp4. Needs of the
/// run folder config.toml, the policy, and the potential if it has one. Errors name the file.
Evaluation evaluate(const std::filesystem::path& run, const EvaluateOptions& options);

}  // namespace stride::evaluation
