#include "train/simulation/engine.h"

#include "extract/error.h"
#include "train/simulation/planar_engine.h"
#include "train/simulation/runner_layout.h"
#include "train/simulation/simbody_engine.h"

namespace stride {

std::unique_ptr<Engine> make_engine(std::string_view name, const Model& model,
                                    const EngineOptions& options) {
  if (name == "planar") return make_planar_engine(model, options);
  if (name == "simbody") return make_simbody_engine(model, options);
  throw Error(fmt::format("engine \"{}\": there is none of this name; engines are {}", name,
                          fmt::join(kEngineNames, ", ")));
}

RunnerState default_state(const Model& model) {
  constexpr double kOpenSimsFiberLength_m = 0.1;  // of a muscle whose file names none (O1)
  const RunnerLayout layout = runner_layout(model);
  RunnerState state;
  for (int i = 0; i < kCoordinates; ++i) {
    state.q[i] = model.coordinates[layout.coordinate[i]].default_value;
    state.u[i] = model.coordinates[layout.coordinate[i]].default_speed;
  }
  for (int i = 0; i < kMuscles; ++i) {
    const Muscle& muscle = model.muscles[layout.muscle[i]];
    state.activation[i] = muscle.default_activation;
    state.fiber_length_m[i] = muscle.default_fiber_length_m.value_or(kOpenSimsFiberLength_m);
  }
  return state;
}

}  // namespace stride
