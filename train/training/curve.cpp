#include "train/training/curve.h"

#include <limits>

#include "extract/io/error.h"

namespace stride::training {
namespace {

double mean(double sum, double count) {
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Table new_curve() {
  Table table;
  table.format = "curve";
  table.metadata = {{"units", "s, m; rewards as of the environment"},
                    {"evaluation", "without noise"}};
  table.columns = {"decisions",
                   "simulated_s",
                   "updates",
                   "episodes",
                   "falls",
                   "failures",
                   "evaluation_distance_m",
                   "evaluation_reward",
                   "evaluation_time_s",
                   "evaluation_falls",
                   "training_distance_m",
                   "training_reward",
                   "critic_loss",
                   "q",
                   "target",
                   "actor_gradient",
                   "critic_gradient"};
  return table;
}

std::vector<double> curve_row(const Progress& progress, double simulated_s,
                              const std::vector<network::EpisodeSummary>& evaluation) {
  const auto n = static_cast<double>(evaluation.size());
  double distance = 0, reward = 0, time = 0, falls = 0;
  for (const network::EpisodeSummary& episode : evaluation) {
    distance += episode.distance_m / n;
    reward += episode.reward / n;
    time += episode.time_s / n;
    falls += (episode.fell ? 1 : 0) / n;
  }
  const Progress::Sums& sums = progress.sums;
  return {static_cast<double>(progress.decisions),
          simulated_s,
          static_cast<double>(progress.updates),
          static_cast<double>(progress.episodes),
          static_cast<double>(progress.falls),
          static_cast<double>(progress.failures),
          distance,
          reward,
          time,
          falls,
          mean(sums.distance_m, sums.episodes),
          mean(sums.reward, sums.episodes),
          mean(sums.critic_loss, sums.updates),
          mean(sums.q, sums.updates),
          mean(sums.target, sums.updates),
          mean(sums.actor_gradient, sums.updates),
          mean(sums.critic_gradient, sums.updates)};
}

Table new_timing() {
  Table table;
  table.format = "timing";
  table.metadata = {{"units", "s of wall clock"}};
  table.columns = {"decisions", "wall_s", "steps_per_s", "updates_per_s"};
  return table;
}

Table load_rows(const std::filesystem::path& file, const Table& empty, std::int64_t rows) {
  Table table = load_table(file, empty.format, empty.version);
  require(table.columns == empty.columns, "{}: its columns are not those of this version",
          file.string());
  require(static_cast<std::int64_t>(table.rows.size()) >= rows,
          "{}: {} rows, the checkpoint has {}: the file was cut", file.string(), table.rows.size(),
          rows);
  table.rows.resize(static_cast<std::size_t>(rows));
  return table;
}

}  // namespace stride::training
