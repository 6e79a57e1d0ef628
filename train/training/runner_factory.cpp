#include "train/training/runner_factory.h"

#include <memory>
#include <optional>

#include "train/environment/runner_environment.h"

namespace stride::training {

EnvironmentFactory make_runners(const EnvironmentOptions& options,
                                const Demonstration& demonstration) {
  const osim::Model model = osim::load_osim(
      options.model.empty() ? osim::default_model_file() : std::filesystem::path(options.model));
  environment::RunnerOptions runner;
  runner.engine = options.engine;
  runner.rules = competition::rules_named(options.rules);
  runner.difficulty = options.difficulty;
  runner.max_obstacles = options.max_obstacles;
  runner.accuracy = options.accuracy;
  if (demonstration.potential) runner.foot = demonstration.potential->foot;

  return [model, runner, reference = demonstration.reference,
          share = options.reference_share](int slot) {
    environment::RunnerOptions own = runner;
    if (slot >= 0 && reference) {
      own.reference = reference;
      own.reference_share = share;
    }
    return std::make_unique<environment::RunnerEnvironment>(model, own);
  };
}

}  // namespace stride::training
