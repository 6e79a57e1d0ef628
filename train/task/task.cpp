#include "train/task/task.h"

#include <algorithm>
#include <array>

#include "extract/io/error.h"
#include "extract/skeleton/movement.h"
#include "train/task/tasks.h"

namespace stride::task {
namespace {

struct Row {
  std::string_view name, measure;
  double time_limit_s, milestone_m;
  std::unique_ptr<Task> (*make)(const TaskOptions&, const osim::Model&);
};

constexpr std::array kTasks{
    Row{"distance", "distance in 10 s", 10, 5, &distance},
    Row{"speed", "distance in 10 s, less what was too fast", 10, 2, &speed},
    Row{"walk", "distance in 10 s on foot, less what was too fast", 10, 2, &walk},
    Row{"long-jump", "length of the jump", 3, 0.2, &long_jump},
    Row{"high-jump", "height of the flight", 3, 0.1, &high_jump},
    Row{"hop", "length of the hop", 3, 0.2, &hop},
};

const Row& row(std::string_view name) {
  const auto found = std::ranges::find(kTasks, name, &Row::name);
  std::string names;
  for (const Row& each : kTasks) names += (names.empty() ? "" : ", ") + std::string(each.name);
  require(found != kTasks.end(), "task.name = {}: must be one of {}", name, names);
  return *found;
}

}  // namespace

double bearing_N(const osim::Model& model) {
  double weight_N = 0;
  for (const osim::Body& body : model.bodies) weight_N -= body.mass_kg * model.gravity_m_s2[1];
  return 0.05 * weight_N;
}

std::unique_ptr<Task> make_task(const TaskOptions& options, const osim::Model& model) {
  return row(options.name).make(options, model);
}

double time_limit_s(std::string_view task) { return row(task).time_limit_s; }

double milestone_m(std::string_view task) { return row(task).milestone_m; }

std::string_view measure_of(std::string_view task) { return row(task).measure; }

std::vector<std::string> task_names() {
  std::vector<std::string> names;
  for (const Row& each : kTasks) names.emplace_back(each.name);
  return names;
}

TaskOptions task_of(std::string_view name, std::string_view what) {
  const Movement& wanted = movement(name, what);
  return {.movement = wanted.name,
          .name = wanted.task,
          .speed_m_s = wanted.task_speed_m_s,
          .effort = wanted.task_effort};
}

}  // namespace stride::task
