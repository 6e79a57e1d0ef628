#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "extract/io/error.h"
#include "extract/io/outputs.h"
#include "train/commands.h"
#include "train/simulation/make_engine.h"
#include "train/simulation/simulate.h"

namespace stride {
namespace {

struct SimulateArguments {
  std::string model, excitations, obstacles, out;
  std::string engine = simulation::kDefaultEngine, rules = "clean", fibres;
  double accuracy = 1e-3;
  std::vector<double> strength;
};

void run(const SimulateArguments& arguments) {
  check_outputs({arguments.model, arguments.excitations, arguments.obstacles},
                {{"--out", arguments.out, FileKind::table}});
  simulation::SimulateOptions options;
  options.engine = arguments.engine;
  options.rules = competition::rules_named(arguments.rules);
  options.accuracy = arguments.accuracy;
  if (!arguments.fibres.empty()) {
    require(arguments.fibres == "equilibrium" || arguments.fibres == "model",
            "--fibres {}: must be equilibrium or model", arguments.fibres);
    options.equilibrate = arguments.fibres == "equilibrium";
  }
  if (!arguments.strength.empty()) {
    require(arguments.strength.size() == 2, "--strength: has {} numbers, must be RIGHT,LEFT",
            arguments.strength.size());
    for (double each : arguments.strength)
      require(each > 0 && each <= 10, "--strength {}: must be in (0, 10]; 1 is the model's own",
              each);
    options.scene.strength_r = arguments.strength[0];
    options.scene.strength_l = arguments.strength[1];
  }
  if (!arguments.obstacles.empty())
    options.scene.obstacles = simulation::load_obstacles(arguments.obstacles);
  const simulation::ExcitationSequence excitations =
      simulation::load_excitations(arguments.excitations);
  const osim::Model model =
      osim::load_osim(arguments.model.empty() ? osim::default_model_file()
                                              : std::filesystem::path(arguments.model));

  const simulation::Simulation simulation = simulation::simulate(model, excitations.steps, options);
  save(simulation.table, arguments.out);
  if (excitations.clipped > 0)
    fmt::print(stderr, "{}: {} values outside of [0, 1] were clipped\n", arguments.excitations,
               excitations.clipped);
  const std::size_t steps = simulation.table.rows.size() - 1;
  fmt::print(stderr, "{} steps, {:.1f} evaluations a step{}\n", steps,
             static_cast<double>(simulation.evaluations) / std::max<double>(1, steps),
             simulation.fell_at_s ? fmt::format(", fell at {:.2f} s", *simulation.fell_at_s) : "");
  require(simulation.failure.empty(), "{}; {} holds what came before", simulation.failure,
          arguments.out);
  fmt::print("{}\n", arguments.out);
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command =
      app.add_subcommand("simulate", "run a sequence of muscle excitations through the simulation");
  command->add_option("--model", arguments->model,
                      "OpenSim model (.osim); default: the runner of Learning to Run");
  command
      ->add_option("--excitations", arguments->excitations,
                   "CSV: one row a step of 0.01 s, one column a muscle")
      ->required();
  command->add_option("--out", arguments->out, "CSV of states and observations")->required();
  command->add_option("--engine", arguments->engine,
                      fmt::format("{} (default {})", fmt::join(simulation::kEngineNames, " or "),
                                  simulation::kDefaultEngine));
  command->add_option("--accuracy", arguments->accuracy, "of the integration (default 1e-3)");
  command->add_option("--rules", arguments->rules,
                      "clean (default), or nips2017: the competition with its faults");
  command->add_option("--fibres", arguments->fibres,
                      "equilibrium or model (not equilibrated); default: as the rules say");
  command->add_option("--obstacles", arguments->obstacles, "CSV: x_m, y_m, radius_m");
  command->add_option("--strength", arguments->strength, "RIGHT,LEFT: of the psoas (default 1,1)")
      ->delimiter(',');
  command->callback([arguments] { run(*arguments); });
}

}  // namespace stride
