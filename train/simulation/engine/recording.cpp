#include "train/simulation/engine/recording.h"

#include <cmath>

#include "calibrate/runner/calibrated.h"
#include "extract/io/error.h"
#include "extract/io/table.h"
#include "train/simulation/engine/runner_layout.h"

namespace stride::simulation {

Recording load_recording(const std::filesystem::path& file) {
  const Table table = load_table(file, "recording", 1);
  require(!table.rows.empty(), "{}: has no steps", file.string());
  std::array<std::size_t, kCoordinates> q, u;
  std::array<std::size_t, kMuscles> activation, fiber, excitation;
  for (std::size_t i = 0; i < q.size(); ++i) {
    q[i] = table.column(kCoordinateNames[i]);
    u[i] = table.column(std::string(kCoordinateNames[i]) + "_u");
  }
  for (std::size_t i = 0; i < fiber.size(); ++i) {
    activation[i] = table.column("activation_" + muscle_names()[i]);
    fiber[i] = table.column("fiber_" + muscle_names()[i]);
    excitation[i] = table.column("excitation_" + muscle_names()[i]);
  }
  const std::size_t time = table.column("time_s");
  Recording recording;
  for (const std::vector<double>& row : table.rows) {
    for (const double value : row)
      require(std::isfinite(value), "{}: a value is missing", file.string());
    RunnerState state{.time_s = row[time]};
    Excitations excitations{};
    for (std::size_t i = 0; i < q.size(); ++i) state.q[i] = row[q[i]], state.u[i] = row[u[i]];
    for (std::size_t i = 0; i < fiber.size(); ++i) {
      state.activation[i] = row[activation[i]];
      state.fiber_length_m[i] = row[fiber[i]];
      excitations[i] = row[excitation[i]];
    }
    recording.states.push_back(state);
    recording.excitations.push_back(excitations);
  }
  return recording;
}

}  // namespace stride::simulation
