#include "train/training/curve.h"

#include <limits>

#include "extract/io/error.h"
#include "train/task/task.h"

namespace stride::training {
namespace {

struct Column {
  const char* name;
  double CurveRow::*value;
};

constexpr Column kColumns[] = {
    {"decisions", &CurveRow::decisions},
    {"simulated_s", &CurveRow::simulated_s},
    {"updates", &CurveRow::updates},
    {"episodes", &CurveRow::episodes},
    {"falls", &CurveRow::falls},
    {"failures", &CurveRow::failures},
    {"evaluation_distance_m", &CurveRow::evaluation_distance_m},
    {"evaluation_reward", &CurveRow::evaluation_reward},
    {"evaluation_time_s", &CurveRow::evaluation_time_s},
    {"evaluation_falls", &CurveRow::evaluation_falls},
    {"training_distance_m", &CurveRow::training_distance_m},
    {"training_reward", &CurveRow::training_reward},
    {"critic_loss", &CurveRow::critic_loss},
    {"q", &CurveRow::q},
    {"target", &CurveRow::target},
    {"actor_gradient", &CurveRow::actor_gradient},
    {"critic_gradient", &CurveRow::critic_gradient},
};
static_assert(sizeof(CurveRow) == std::size(kColumns) * sizeof(double), "every value has a column");

double mean(double sum, double count) {
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Table new_curve(const std::string& task) {
  Table table;
  table.format = "curve";
  table.metadata = {{"units", "s, m; rewards as of the environment"},
                    {"evaluation", "without noise"}};
  if (task != task::TaskOptions().name)
    table.set_meta("measure", std::string(task::measure_of(task)));
  for (const Column& column : kColumns) table.columns.emplace_back(column.name);
  return table;
}

std::vector<double> CurveRow::values() const {
  std::vector<double> values;
  for (const Column& column : kColumns) values.push_back(this->*column.value);
  return values;
}

CurveRow curve_row(const Progress& progress, double simulated_s,
                   const std::vector<network::EpisodeSummary>& evaluation) {
  CurveRow row;
  row.decisions = static_cast<double>(progress.decisions);
  row.simulated_s = simulated_s;
  row.updates = static_cast<double>(progress.updates);
  row.episodes = static_cast<double>(progress.episodes);
  row.falls = static_cast<double>(progress.falls);
  row.failures = static_cast<double>(progress.failures);
  const auto n = static_cast<double>(evaluation.size());
  for (const network::EpisodeSummary& episode : evaluation) {
    row.evaluation_distance_m += episode.distance_m / n;
    row.evaluation_reward += episode.reward / n;
    row.evaluation_time_s += episode.time_s / n;
    row.evaluation_falls += (episode.fell ? 1 : 0) / n;
  }
  const Progress::Sums& sums = progress.sums;
  row.training_distance_m = mean(sums.distance_m, sums.episodes);
  row.training_reward = mean(sums.reward, sums.episodes);
  row.critic_loss = mean(sums.critic_loss, sums.updates);
  row.q = mean(sums.q, sums.updates);
  row.target = mean(sums.target, sums.updates);
  row.actor_gradient = mean(sums.actor_gradient, sums.updates);
  row.critic_gradient = mean(sums.critic_gradient, sums.updates);
  return row;
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
