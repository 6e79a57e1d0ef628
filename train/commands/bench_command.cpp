#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "extract/io/data_file.h"
#include "extract/io/error.h"
#include "train/commands.h"
#include "train/simulation/bench.h"
#include "train/simulation/make_engine.h"

namespace stride {
namespace {

using nlohmann::json;

struct BenchArguments {
  std::string engine, model, workload = "both";
  simulation::BenchOptions bench;
  int rollouts = 24;
  bool json = false, accuracy_table = false;
};

nlohmann::ordered_json to_json(const simulation::BenchResult& r) {
  return {{"engine", r.engine},
          {"workload", r.workload},
          {"steps_per_s", r.steps_per_s()},
          {"realtime_factor", r.realtime_factor()},
          {"evaluations_per_step", r.evaluations_per_step()},
          {"us_per_evaluation", r.us_per_evaluation()},
          {"accuracy", r.accuracy},
          {"threads", r.threads},
          {"steps", r.steps},
          {"wall_s", r.wall_s},
          {"cpu_s", r.cpu_s},
          {"steps_per_cpu_s", r.steps_per_cpu_s()},
          {"rejected_per_step", static_cast<double>(r.rejected) / static_cast<double>(r.steps)},
          {"falls", r.falls},
          {"time_limits", r.time_limits},
          {"failures", r.failures},
          {"resident_start_MiB", r.resident_start_MiB},
          {"resident_MiB", r.resident_MiB}};
}

/// One JSON object. For two engines the fields are those of the default one, and `engines` holds
/// both.
nlohmann::ordered_json to_json(const std::vector<simulation::BenchResult>& results) {
  nlohmann::ordered_json object = to_json(results.back());
  if (results.size() > 1) {
    object["engines"] = json::array();
    for (const simulation::BenchResult& each : results) object["engines"].push_back(to_json(each));
    object["times_as_fast"] = results.back().steps_per_cpu_s() / results.front().steps_per_cpu_s();
  }
  return object;
}

void print_table(const std::vector<simulation::BenchResult>& results) {
  fmt::print("{:8} {:8} {:>8} {:>10} {:>10} {:>10} {:>9} {:>10} {:>8} {:>9} {:>8}\n", "engine",
             "workload", "threads", "steps/s", "steps/s/c", "x realtime", "evals/st", "us/eval",
             "falls", "failures", "MiB");
  for (const simulation::BenchResult& r : results) {
    fmt::print("{:8} {:8} {:8} {:10.0f} {:10.0f} {:10.1f} {:9.1f} {:10.3f} {:8} {:9} {:8.1f}\n",
               r.engine, r.workload, r.threads, r.steps_per_s(), r.steps_per_cpu_s(),
               r.realtime_factor(), r.evaluations_per_step(), r.us_per_evaluation(), r.falls,
               r.failures, r.resident_MiB);
  }
  for (const simulation::BenchResult& r : results) {
    if (!r.first_failure.empty()) {
      fmt::print(stderr, "{}: {} episodes ended in a failure, the first one: {}\n", r.engine,
                 r.failures, r.first_failure);
    }
  }
}

void run_table(const BenchArguments& arguments, const osim::Model& model) {
  simulation::AccuracyOptions options;
  options.rollouts = arguments.rollouts;
  options.seed = arguments.bench.seed;
  options.engines.assign(simulation::kEngineNames.begin(), simulation::kEngineNames.end());
  if (!arguments.engine.empty()) options.engines = {arguments.engine};
  const std::vector<simulation::AccuracyRow> rows = simulation::accuracy_table(model, options);
  nlohmann::ordered_json all = json::array();
  if (!arguments.json) {
    fmt::print("{:8} {:>9} {:>9} {:>10} {:>9} {:>9} {:>9}\n", "engine", "accuracy", "evals/st",
               "steps/s/c", "median", "p90", "worst");
  }
  for (const simulation::AccuracyRow& r : rows) {
    all.push_back({{"engine", r.engine},
                   {"accuracy", r.accuracy},
                   {"evaluations_per_step", r.evaluations_per_step},
                   {"steps_per_cpu_s", r.steps_per_cpu_s},
                   {"median_error", r.median_error},
                   {"p90_error", r.p90_error},
                   {"worst_error", r.worst_error}});
    if (!arguments.json) {
      fmt::print("{:8} {:9.0e} {:9.1f} {:10.0f} {:9.1e} {:9.1e} {:9.1e}\n", r.engine, r.accuracy,
                 r.evaluations_per_step, r.steps_per_cpu_s, r.median_error, r.p90_error,
                 r.worst_error);
    }
  }
  if (arguments.json) fmt::print("{}\n", all.dump(2));
}

void run(const BenchArguments& arguments) {
  const simulation::BenchOptions& options = arguments.bench;
  require(options.seconds > 0 && options.seconds < 1e6,
          "--seconds {}: must be positive; 2 is enough on an idle machine", options.seconds);
  require(options.threads >= 1 && options.threads <= 256, "--threads {}: must be 1 to 256",
          options.threads);
  require(options.steps >= 0, "--steps {}: must not be negative", options.steps);
  require(options.engine.accuracy > 0 && options.engine.accuracy <= 1,
          "--accuracy {}: must be in (0, 1]; 1e-3 is the default", options.engine.accuracy);
  require(options.engine.fixed_step_s >= 1e-6 && options.engine.fixed_step_s <= 0.01,
          "--step-size {}: must be 1e-6 to 0.01 s; 2.5e-4 is the default",
          options.engine.fixed_step_s);
  require(options.obstacles >= 0 && options.obstacles <= 1000, "--obstacles {}: must be 0 to 1000",
          options.obstacles);
  require(arguments.rollouts >= 1, "--rollouts {}: must be at least 1", arguments.rollouts);
  const osim::Model model =
      osim::load_osim(arguments.model.empty() ? osim::default_model_file()
                                              : std::filesystem::path(arguments.model));
  if (arguments.accuracy_table) return run_table(arguments, model);
  std::vector<std::string> engines(simulation::kEngineNames.begin(),
                                   simulation::kEngineNames.end());
  if (!arguments.engine.empty()) engines = {arguments.engine};
  std::vector<simulation::BenchResult> random, running;
  if (arguments.workload != "running") random = simulation::bench(engines, model, options);
  if (arguments.workload != "random") {
    simulation::BenchOptions recorded = options;
    recorded.running = simulation::load_recording(data_file("train/agents/stride/running.csv"));
    running = simulation::bench(engines, model, recorded);
  }
  if (!arguments.json) {
    std::vector<simulation::BenchResult> all = random;
    all.insert(all.end(), running.begin(), running.end());
    return print_table(all);
  }
  nlohmann::ordered_json object = to_json(random.empty() ? running : random);
  if (!random.empty() && !running.empty()) object["running"] = to_json(running);
  fmt::print("{}\n", object.dump(2));
}

}  // namespace

void add_bench_command(CLI::App& app) {
  auto arguments = std::make_shared<BenchArguments>();
  BenchArguments& a = *arguments;
  CLI::App* command = app.add_subcommand(
      "bench", "How fast the simulation is, under random excitations and under those of a run");
  command->add_option("--engine", a.engine, "simbody or planar; without: both, side by side");
  command->add_option("--model", a.model, "an OpenSim model; default: the runner that ships");
  command
      ->add_option("--workload", a.workload,
                   "random excitations, which fall; running: those of a recorded run; or both")
      ->check(CLI::IsMember({"random", "running", "both"}))
      ->capture_default_str();
  command->add_option("--seconds", a.bench.seconds, "of wall time for each engine and workload")
      ->capture_default_str();
  command->add_option("--steps", a.bench.steps,
                      "this many steps of 0.01 s on each thread instead of --seconds");
  command->add_option("--threads", a.bench.threads, "runners at once")->capture_default_str();
  command->add_option("--accuracy", a.bench.engine.accuracy, "of the integration")
      ->capture_default_str();
  command->add_flag("--fixed-step", a.bench.engine.fixed_step,
                    "steps of --step-size without error control");
  command->add_option("--step-size", a.bench.engine.fixed_step_s, "s")->capture_default_str();
  command->add_option("--obstacles", a.bench.obstacles, "drawn anew for each episode")
      ->capture_default_str();
  command->add_option("--seed", a.bench.seed)->capture_default_str();
  command->add_flag("--json", a.json, "print one JSON object");
  command->add_flag("--accuracy-table", a.accuracy_table,
                    "instead: speed against error after one second, for several accuracies");
  command->add_option("--rollouts", a.rollouts, "of the accuracy table")->capture_default_str();
  command->callback([arguments] { run(*arguments); });
}

}  // namespace stride
