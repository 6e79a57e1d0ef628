#include "train/simulation/engine/runner_layout.h"

#include <algorithm>

#include "calibrate/runner/calibrated.h"
#include "extract/io/error.h"

namespace stride::simulation {

const std::array<std::string, kMuscles>& muscle_names() {
  static const std::array<std::string, kMuscles> names = [] {
    constexpr const char* kOfLeg[] = {"hamstrings", "bifemsh", "glut_max", "iliopsoas", "rect_fem",
                                      "vasti",      "gastroc", "soleus",   "tib_ant"};
    static_assert(std::size(kOfLeg) == kMusclesOfLeg, "every muscle of a leg has a name");
    std::array<std::string, kMuscles> all;
    for (int i = 0; i < kMuscles; ++i)
      all[i] = std::string(kOfLeg[i % kMusclesOfLeg]) + (i < kMusclesOfLeg ? "_r" : "_l");
    return all;
  }();
  return names;
}

RunnerLayout runner_layout(const osim::Model& model) {
  RunnerLayout layout;
  for (int i = 0; i < kCoordinates; ++i) {
    layout.coordinate[i] = model.coordinate(kCoordinateNames[i]);
    require(layout.coordinate[i] >= 0 && !model.coordinates[layout.coordinate[i]].locked,
            "model {}: has no free coordinate {}; a runner needs {}", model.name,
            kCoordinateNames[i], fmt::join(kCoordinateNames, ", "));
  }
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    require(model.coordinates[i].locked ||
                std::count(layout.coordinate.begin(), layout.coordinate.end(), i) == 1,
            "model {}: coordinate {} is not one of the runner's; lock it", model.name,
            model.coordinates[i].name);
  require(model.muscles.size() == kMuscles, "model {}: has {} muscles; a runner has {}", model.name,
          model.muscles.size(), kMuscles);
  for (int i = 0; i < kMuscles; ++i) {
    layout.muscle[i] = model.muscle(muscle_names()[i]);
    require(layout.muscle[i] >= 0, "model {}: has no muscle {}; a runner has {}", model.name,
            muscle_names()[i], fmt::join(muscle_names(), ", "));
  }
  return layout;
}

Excitations mirrored(const Excitations& excitations) {
  Excitations result = excitations;
  std::rotate(result.begin(), result.begin() + kMusclesOfLeg, result.end());
  return result;
}

RunnerState mirrored(const RunnerState& state) {
  RunnerState result = state;
  for (auto* each : {&result.q, &result.u})
    std::swap_ranges(each->begin() + kHipRight, each->begin() + kHipLeft, each->begin() + kHipLeft);
  result.activation = mirrored(state.activation);
  result.fiber_length_m = mirrored(state.fiber_length_m);
  return result;
}

RunnerState default_state(const osim::Model& model) {
  constexpr double kOpenSimsFiberLength_m = 0.1;  // of a muscle without a default in the file
  const RunnerLayout layout = runner_layout(model);
  RunnerState state;
  for (int i = 0; i < kCoordinates; ++i) {
    state.q[i] = model.coordinates[layout.coordinate[i]].default_value;
    state.u[i] = model.coordinates[layout.coordinate[i]].default_speed;
  }
  for (int i = 0; i < kMuscles; ++i) {
    const osim::Muscle& muscle = model.muscles[layout.muscle[i]];
    state.activation[i] = muscle.default_activation;
    state.fiber_length_m[i] = muscle.default_fiber_length_m.value_or(kOpenSimsFiberLength_m);
  }
  return state;
}

}  // namespace stride::simulation
