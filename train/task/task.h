#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "train/simulation/competition/rules.h"
#include "train/simulation/engine/engine.h"

namespace stride::task {

/// What an agent is to do.
struct TaskOptions {
  std::string movement = "run";   // whose task it is; a name of movements.toml
  std::string name = "distance";  // a row of kTasks in task.cpp
  double speed_m_s = 0;           // that "speed" wants
  double effort = 0;              // what mean squared activation costs, m/s
  double slip = 0;                // what a metre that a foot slides costs "walk", m
};

/// What a task sees of the runner: at the start of an episode and after each step of 0.01 s.
struct Moment {
  const simulation::RunnerState& state;
  const simulation::RunnerKinematics& kinematics;
  competition::Reward competition;  // of the step
  double step_s = competition::kStep_s;
};

/// How a step ends an episode: it goes on, the runner fell, or what was to be done is done, after
/// which the runner stands as it would for ever.
enum class End { none, fall, done };

struct Outcome {
  double reward = 0;  // m
  End end = End::none;
};

/// A task: its reward, its end and its measure of success. It remembers the running episode.
class Task {
 public:
  virtual ~Task() = default;
  virtual void start(const Moment& first) = 0;
  virtual Outcome step(const Moment& moment) = 0;
  /// How well the episode went so far, m: the more, the better.
  virtual double measure_m() const = 0;
};

/// What a foot on the ground bears at least: 5 % of the body's weight.
double bearing_N(const osim::Model& model);

/// Throws Error naming the option that is out of range, with the list of tasks.
std::unique_ptr<Task> make_task(const TaskOptions& options, const osim::Model& model);

/// Simulated time after which an episode is cut, s.
double time_limit_s(std::string_view task);
/// What measure_m() is, for axes and reports: "distance in 10 s".
std::string_view measure_of(std::string_view task);
/// Measures that are worth telling apart in a report are so far apart, m. Throws Error for an
/// unknown task.
double milestone_m(std::string_view task);
/// The names of all tasks.
std::vector<std::string> task_names();
/// The task of a movement. Throws Error, beginning with `what`, where there is no such movement.
TaskOptions task_of(std::string_view movement, std::string_view what);

}  // namespace stride::task
