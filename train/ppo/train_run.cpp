#include "train/ppo/train_run.h"

#include "train/ppo/train.h"

namespace stride {

training::TrainSummary train_run(const std::filesystem::path& run,
                                 const training::EnvironmentFactory& make_environment,
                                 const std::atomic<bool>& stop, std::FILE* messages) {
  const bool ppo = training::load_run_options(run).run.learner == "ppo";
  return (ppo ? ppo::train : training::train)(run, make_environment, stop, messages);
}

}  // namespace stride
