#pragma once

#include <filesystem>
#include <optional>

#include "calibrate/runner/calibrated.h"
#include "shaping/potential.h"
#include "train/training/options.h"

namespace stride::training {

/// A demonstration: the potential that shapes the reward, and the run itself, from which episodes
/// may start (reference state initialisation, Peng et al. 2018).
struct Demonstration {
  std::optional<Potential> potential;
  std::optional<CalibratedTrajectory> reference;
};

/// Reads NAME.potential.json and, if reference_share > 0, NAME.calibrated.csv beside it or
/// `reference` if given. Either may be empty; without both the demonstration is empty. Throws Error
/// naming the missing file and the cure.
Demonstration load_demonstration(const std::filesystem::path& potential,
                                 const std::filesystem::path& reference,
                                 const EnvironmentOptions& options);

/// The copies in a run folder, named by its configuration. save() sets these names in `options`;
/// loading applies the overrides of the potential.
void save(const Demonstration& demonstration, const std::filesystem::path& run,
          TrainOptions& options);
Demonstration load_run_demonstration(const TrainOptions& options, const std::filesystem::path& run);

}  // namespace stride::training
