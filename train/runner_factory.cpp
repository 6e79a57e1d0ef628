#include "train/runner_factory.h"

#include <memory>
#include <optional>

#include "train/runner_environment.h"

namespace stride {

EnvironmentFactory make_runners(const EnvironmentOptions& options,
                                const Demonstration& demonstration) {
  const Model model = load_osim(options.model.empty() ? default_model_file()
                                                      : std::filesystem::path(options.model));
  RunnerOptions runner;
  runner.engine = options.engine;
  runner.rules = rules_named(options.rules);
  runner.difficulty = options.difficulty;
  runner.max_obstacles = options.max_obstacles;
  runner.accuracy = options.accuracy;
  if (demonstration.potential) runner.foot = demonstration.potential->foot;

  return [model, runner, reference = demonstration.reference,
          share = options.reference_share](int slot) {
    RunnerOptions own = runner;
    if (slot >= 0 && reference) {
      own.reference = reference;
      own.reference_share = share;
    }
    return std::make_unique<RunnerEnvironment>(model, own);
  };
}

}  // namespace stride
