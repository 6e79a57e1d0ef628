#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "train/network/policy.h"
#include "train/training/training.h"

namespace stride::evaluation {

/// Mean, spread and falls of episodes. NaN where there are too few.
struct EpisodeStatistics {
  double distance_m = 0, distance_se_m = 0;          // over all
  std::pair<double, double> distance_95_m = {0, 0};  // 95 % interval of that mean
  double finished_distance_m = 0;                    // over those that did not end early
  int falls = 0;
  std::pair<double, double> fall_share_95 = {0, 0};  // 95 % interval (Wilson 1927)
};
EpisodeStatistics statistics_of(const std::vector<network::EpisodeSummary>& episodes);

/// Index of the episode with the median distance, the lower of two.
std::size_t median_episode(const std::vector<network::EpisodeSummary>& episodes);

/// Episodes of seeds first_seed, first_seed + 1, … by the policy in a file, without chance, on
/// `threads` threads (0: one a core). The result does not depend on their number.
std::vector<network::EpisodeSummary> run_episodes(
    const std::filesystem::path& policy, const training::TrainOptions& options,
    const Potential* potential, const training::EnvironmentFactory& make_environment,
    std::uint64_t first_seed, int episodes, int threads);

}  // namespace stride::evaluation
