#include "train/evaluation/episodes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "train/training/thread_pool.h"

namespace stride::evaluation {
namespace {

constexpr double kNormal95 = 1.959964;

/// Of a share of `count` in n (Wilson 1927).
std::pair<double, double> wilson_95(double count, double n) {
  const double z2 = kNormal95 * kNormal95, share = count / n;
  const double centre = (share + z2 / (2 * n)) / (1 + z2 / n);
  const double half =
      kNormal95 / (1 + z2 / n) * std::sqrt(share * (1 - share) / n + z2 / (4 * n * n));
  return {std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

template <typename Scalar>
std::vector<network::EpisodeSummary> run(const std::filesystem::path& file,
                                         const training::TrainOptions& options,
                                         const Potential* potential,
                                         const training::EnvironmentFactory& make_environment,
                                         std::uint64_t first_seed, int count, int threads) {
  training::ThreadPool pool(threads);
  const std::size_t lanes = static_cast<std::size_t>(std::min(pool.size(), count));
  std::vector<network::EpisodeSummary> episodes(static_cast<std::size_t>(count));
  pool.run(static_cast<int>(lanes), [&](int lane) {
    const auto environment = make_environment(-1);
    environment::Observer observer =
        training::make_observer(options, potential, environment->spec());
    const auto policy =
        network::load_policy<Scalar>(file, observer.names(), environment->spec().action_names);
    for (auto i = static_cast<std::size_t>(lane); i < episodes.size(); i += lanes)
      episodes[i] = network::run_episode(policy, *environment, observer, potential,
                                         options.run.action_repeat, first_seed + i, nullptr);
  });
  return episodes;
}

}  // namespace

EpisodeStatistics statistics_of(const std::vector<network::EpisodeSummary>& episodes) {
  const auto n = static_cast<double>(episodes.size());
  EpisodeStatistics result;
  double sum = 0, finished = 0, squares = 0;
  for (const network::EpisodeSummary& episode : episodes) {
    sum += episode.distance_m;
    result.falls += episode.fell;
    if (!episode.fell) finished += episode.distance_m;
  }
  result.distance_m = sum / n;
  result.finished_distance_m = result.falls < n ? finished / (n - result.falls) : NAN;
  for (const network::EpisodeSummary& episode : episodes)
    squares += std::pow(episode.distance_m - result.distance_m, 2);
  result.distance_se_m = n > 1 ? std::sqrt(squares / (n - 1) / n) : NAN;
  const double half = kNormal95 * result.distance_se_m;
  result.distance_95_m = {result.distance_m - half, result.distance_m + half};
  result.fall_share_95 = wilson_95(result.falls, n);
  return result;
}

std::size_t median_episode(const std::vector<network::EpisodeSummary>& episodes) {
  std::vector<std::size_t> order(episodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return episodes[i].distance_m; });
  return order[(order.size() - 1) / 2];
}

std::vector<network::EpisodeSummary> run_episodes(
    const std::filesystem::path& policy, const training::TrainOptions& options,
    const Potential* potential, const training::EnvironmentFactory& make_environment,
    std::uint64_t first_seed, int episodes, int threads) {
  return (options.run.precision == "float" ? run<float> : run<double>)(policy, options, potential,
                                                                       make_environment, first_seed,
                                                                       episodes, threads);
}

}  // namespace stride::evaluation
