#include "train/simulation/simulate.h"

#include <algorithm>
#include <cmath>

#include "calibrate/runner/calibrated.h"
#include "extract/io/error.h"
#include "train/simulation/competition/sensors.h"
#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/make_engine.h"

namespace stride::simulation {
namespace {

constexpr int kCompetitionObstacles = 3;

/// Where each column of the table comes from: -1 the time, else an index into the observations.
std::vector<int> columns_of(std::vector<std::string>& columns) {
  const std::vector<std::string>& names = competition::Sensors::names();
  columns = {"time_s"};
  for (const char* suffix : {"", "_u"})
    for (const char* name : kCoordinateNames) columns.push_back(std::string(name) + suffix);
  for (int i = 0; i < competition::Sensors::kCompetition; ++i)
    if (std::find(columns.begin(), columns.end(), names[i]) == columns.end())
      columns.push_back(names[i]);
  std::vector<int> sources{-1};
  for (std::size_t i = 1; i < columns.size(); ++i)
    sources.push_back(
        static_cast<int>(std::find(names.begin(), names.end(), columns[i]) - names.begin()));
  return sources;
}

}  // namespace

ExcitationSequence load_excitations(const std::filesystem::path& file) {
  const Table table = load_csv(file);
  const auto& names = muscle_names();
  std::array<std::size_t, kMuscles> column{};
  for (int i = 0; i < kMuscles; ++i) {
    require(table.has_column(names[i]), "{}: has no column {}: must have one for each of {}",
            file.string(), names[i], fmt::join(names, ", "));
    column[i] = table.column(names[i]);
  }
  for (const std::string& each : table.columns)
    require(each == "time_s" || std::find(names.begin(), names.end(), each) != names.end(),
            "{}: column {}: there is no such muscle; muscles are {}", file.string(), each,
            fmt::join(names, ", "));
  require(!table.rows.empty(), "{}: has no rows: one a step of 0.01 s is needed", file.string());
  ExcitationSequence sequence;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    Excitations& step = sequence.steps.emplace_back();
    for (int i = 0; i < kMuscles; ++i) {
      const double value = table.rows[row][column[i]];
      require(std::isfinite(value), "{}: step {}, {}: {}: must be a number in [0, 1]",
              file.string(), row + 1, names[i], std::isnan(value) ? "empty or NaN" : "infinite");
      step[i] = std::clamp(value, 0.0, 1.0);
      sequence.clipped += step[i] != value;
    }
  }
  return sequence;
}

std::vector<Obstacle> load_obstacles(const std::filesystem::path& file) {
  const Table table = load_csv(file);
  const std::size_t x = table.column("x_m"), y = table.column("y_m"), r = table.column("radius_m");
  require(table.columns.size() == 3, "{}: has {} columns: must be x_m, y_m, radius_m",
          file.string(), table.columns.size());
  std::vector<Obstacle> obstacles;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::vector<double>& cells = table.rows[row];
    require(std::isfinite(cells[x]) && std::isfinite(cells[y]) && std::isfinite(cells[r]) &&
                cells[r] > 0,
            "{}: obstacle {}: x_m {}, y_m {}, radius_m {}: must be numbers, radius_m > 0",
            file.string(), row + 1, cells[x], cells[y], cells[r]);
    obstacles.push_back({cells[x], cells[y], cells[r]});
  }
  std::sort(obstacles.begin(), obstacles.end(),
            [](const Obstacle& a, const Obstacle& b) { return a.x_m < b.x_m; });
  return obstacles;
}

Simulation simulate(const osim::Model& model, const std::vector<Excitations>& excitations,
                    const SimulateOptions& options) {
  require(options.accuracy > 0 && options.accuracy <= 0.1,
          "accuracy = {}: must be in (0, 0.1]; 1e-3 is usual", options.accuracy);
  EngineOptions engine_options;
  engine_options.accuracy = options.accuracy;
  // A stiff step of 0.01 s takes 2000 evaluations at 1e-7 and three times as many at 1e-9; the
  // bound at which sliding along a chattering contact begins must be larger.
  if (options.accuracy < 1e-7) engine_options.max_evaluations *= 20;
  const auto engine = simulation::make_engine(options.engine, model,
                                              competition::under(options.rules, engine_options));
  const competition::Sensors sensors(model);
  competition::arrange(options.scene, options.rules, kCompetitionObstacles, *engine);
  engine->set_state(simulation::default_state(model));
  if (options.equilibrate.value_or(options.rules == competition::Rules::clean))
    engine->equilibrate_fibers();

  Simulation result;
  const std::vector<int> sources = columns_of(result.table.columns);
  std::vector<double> observation(competition::Sensors::names().size());
  const auto add_row = [&](double time_s) {
    sensors.read(engine->state(), engine->kinematics(), options.scene, options.rules,
                 kCompetitionObstacles, observation.data());
    std::vector<double>& row = result.table.rows.emplace_back();
    for (int source : sources) row.push_back(source < 0 ? time_s : observation[source]);
    if (!result.fell_at_s && competition::has_fallen(engine->state())) result.fell_at_s = time_s;
  };
  add_row(0);
  for (std::size_t step = 0; step < excitations.size(); ++step) {
    const AdvanceReport report = engine->advance(excitations[step], competition::kStep_s);
    result.evaluations += report.evaluations;
    if (!report.ok) {
      result.failure = fmt::format("{:.4f} s: the state cannot be integrated: {}",
                                   engine->state().time_s, report.failure);
      break;
    }
    add_row(static_cast<double>(step + 1) / 100);
  }
  return result;
}

}  // namespace stride::simulation
