#include "train/python/runners.h"

#include <algorithm>
#include <cmath>

#include "extract/io/error.h"
#include "train/ddpg/replay_buffer.h"
#include "train/simulation/competition/sensors.h"

namespace stride::python {

struct Runners::Runner {
  Runner(const osim::Model& model, const RunnersOptions& options)
      : environment(model, options.runner),
        observer(environment.spec(), options.features,
                 environment.spec().step_s * options.action_repeat),
        action(Eigen::VectorXd::Zero(simulation::kMuscles)) {}

  environment::RunnerEnvironment environment;
  environment::Observer observer;
  Eigen::VectorXd action, features;
  std::uint64_t seed = 0;      // of the episode
  bool over = false;           // the next step starts another episode
  competition::Reward reward;  // of the last step of the runner, summed over the repeated action
};

Runners::Runners(const RunnersOptions& options) : options_(options), pool_(options.threads) {
  require(options.count >= 1 && options.count <= 100'000, "n = {}: must be 1 to 100000",
          options.count);
  require(options.threads <= 1024, "threads = {}: must be at most 1024", options.threads);
  require(options.action_repeat >= 1 && options.action_repeat <= 100,
          "action_repeat = {}: must be 1 to 100", options.action_repeat);
  require(options.observation == "competition" || options.observation == "all" ||
              options.observation == "agent",
          "observation = {}: must be competition, all or agent", options.observation);
  const osim::Model model = osim::load_osim(
      options.model.empty() ? osim::default_model_file() : std::filesystem::path(options.model));
  if (options.potential) {
    require(options.potential->model == model.name,
            "potential of {}: was made for the model {}, the runner is {}; convert the clip with "
            "--model",
            options.potential->source, options.potential->model, model.name);
    options_.runner.foot = options.potential->foot;
  }
  options_.features.phase = options.potential && options.potential->index == PotentialIndex::time;
  for (int i = 0; i < options.count; ++i)
    runners_.push_back(std::make_shared<Runner>(model, options_));
  action_names_ = runners_[0]->environment.spec().action_names;
  observation_names_ = options.observation == "agent"
                           ? runners_[0]->observer.names()
                           : runners_[0]->environment.spec().observation_names;
  if (options.observation == "competition")
    observation_names_.resize(competition::Sensors::kCompetition);
}

const environment::RunnerEnvironment& Runners::environment(int runner) const {
  require(runner >= 0 && runner < count(), "runner {}: there are {}", runner, count());
  return runners_[static_cast<std::size_t>(runner)]->environment;
}

void Runners::reset(std::uint64_t seed, const StepArrays& arrays) {
  pool_.run(count(), [&](int i) { reset_one(i, seed + static_cast<std::uint64_t>(i), arrays); });
}

void Runners::reset_one(int runner, std::uint64_t seed, const StepArrays& arrays) {
  const auto i = static_cast<std::size_t>(runner);
  runners_[i]->seed = seed;
  start(*runners_[i], i, arrays);
}

void Runners::step(std::span<const double> actions, const StepArrays& arrays) {
  pool_.run(count(), [&](int task) {
    const auto i = static_cast<std::size_t>(task);
    Runner& runner = *runners_[i];
    if (runner.over) {
      runner.seed += static_cast<std::uint64_t>(count());
      start(runner, i, arrays);
    } else {
      advance(runner, i, actions.subspan(i * simulation::kMuscles, simulation::kMuscles), arrays);
    }
  });
}

void Runners::start(Runner& runner, std::size_t i, const StepArrays& arrays) {
  const Eigen::VectorXd& observation = runner.environment.reset(runner.seed);
  runner.over = false;
  runner.reward = {};
  arrays.terminated[i] = arrays.truncated[i] = arrays.failed[i] = false;
  write(runner, i, observation, true, arrays);
}

void Runners::advance(Runner& runner, std::size_t i, std::span<const double> action,
                      const StepArrays& arrays) {
  std::ranges::copy(action, runner.action.begin());
  runner.reward = {};
  const environment::Step* last = nullptr;
  for (int k = 0; k < options_.action_repeat && !runner.over; ++k) {
    const environment::Step& step = *(last = &runner.environment.step(runner.action));
    runner.reward.forward += runner.environment.reward().forward;
    runner.reward.ligament += runner.environment.reward().ligament;
    arrays.terminated[i] = step.terminated;
    arrays.truncated[i] = step.truncated;
    arrays.failed[i] = step.failed;
    runner.over = step.terminated || step.truncated;
  }
  write(runner, i, last->observation, false, arrays);
}

void Runners::write(Runner& runner, std::size_t i, const Eigen::VectorXd& observation, bool first,
                    const StepArrays& arrays) {
  const environment::RunnerEnvironment& environment = runner.environment;
  const double phase = !options_.potential ? 0
                                           : environment.initial_phase() +
                                                 options_.potential->phase_at(environment.time_s());
  const Eigen::VectorXd* values = &observation;
  if (options_.observation == "agent") {
    first ? runner.observer.start(observation, phase, runner.features)
          : runner.observer.follow(observation, phase, runner.features);
    values = &runner.features;
  }
  const std::size_t size = observation_names_.size();
  std::copy_n(values->begin(), size,
              arrays.observations.begin() + static_cast<std::ptrdiff_t>(i * size));
  const Pose pose = environment.pose();
  std::ranges::copy(pose.m, arrays.poses.begin() + static_cast<std::ptrdiff_t>(i * pose.m.size()));
  arrays.forward[i] = runner.reward.forward;
  arrays.ligament[i] = runner.reward.ligament;
  arrays.rewards[i] = runner.reward.sum();
  arrays.distances_m[i] = environment.distance_m();
  arrays.times_s[i] = environment.time_s();
  arrays.phases[i] = phase - std::floor(phase);
  arrays.phis[i] = options_.potential ? (*options_.potential)(pose, phase) : 0;
}

}  // namespace stride::python
