#include "train/ppo/train_run.h"

#include "extract/io/error.h"
#include "train/ppo/train.h"

namespace stride {

training::TrainSummary train_run(const std::filesystem::path& run,
                                 const training::EnvironmentFactory& make_environment,
                                 const std::atomic<bool>& stop, std::FILE* messages,
                                 parallel::Ranks& ranks) {
  const bool ppo = training::load_run_options(run).run.learner == "ppo";
  const auto train = ppo ? ppo::train : training::train;
  return train(run, make_environment, stop, messages, ranks);
}

}  // namespace stride
