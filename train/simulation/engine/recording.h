#pragma once

#include <filesystem>
#include <vector>

#include "train/simulation/engine/engine.h"

namespace stride::simulation {

/// A stretch of an episode: the state before each step of 0.01 s, and the excitations of the step.
struct Recording {
  std::vector<RunnerState> states;
  std::vector<Excitations> excitations;
};

/// Reads `# stride recording 1`: columns time_s, the nine coordinates, their speeds (_u), and of
/// each muscle activation_, fiber_ and excitation_ with its name; SI and rad. Throws Error naming
/// the file if it holds no step, or a value that is none.
Recording load_recording(const std::filesystem::path& file);

}  // namespace stride::simulation
