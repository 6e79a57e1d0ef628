#include "train/training/runner_factory.h"

#include <cmath>
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
  runner.late_positions = options.late_positions;
  runner.raw_fibres = options.raw_fibres;
  runner.drop_contacts = options.drop_contacts;
  runner.task = options.task;
  if (demonstration.potential) runner.foot = demonstration.potential->foot;

  return [model, runner, reference = demonstration.reference, options](int slot) {
    environment::RunnerOptions own = runner;
    if (slot >= 0 && options.training_accuracy > 0) own.accuracy = options.training_accuracy;
    if (slot >= 0) {
      own.drop_share = options.drop_share;
      own.backward_knees = options.backward_knees;
      own.flat_share = options.flat_share;
      own.few_share = options.few_share;
    }
    if (slot >= 0 && reference) {
      own.reference = reference;
      own.imitation = options.imitation;
      own.reference_share = options.reference_share;
      if (options.reference_by_slot)  // of any consecutive ones the same share
        own.reference_share = std::floor((slot + 1) * options.reference_share) >
                                      std::floor(slot * options.reference_share)
                                  ? 1
                                  : 0;
    }
    return std::make_unique<environment::RunnerEnvironment>(model, own);
  };
}

}  // namespace stride::training
