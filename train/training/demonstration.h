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

/// Reads NAME.potential.json and, where `options` want episodes to start on the reference
/// (reference_share > 0), NAME.calibrated.csv beside it or `reference` if that is given. Either may
/// be empty; without both the demonstration is. Throws Error naming the file that is missing and
/// the cure, or what of the potential is no movement on the model, or not of the task, of
/// `options`.
Demonstration load_demonstration(const std::filesystem::path& potential,
                                 const std::filesystem::path& reference,
                                 const EnvironmentOptions& options);

/// The copies in a run folder, named by its configuration. name_copies(), which save() calls, sets
/// these names in `options`; loading applies the overrides of the potential.
void name_copies(const Demonstration& demonstration, TrainOptions& options);
void save(const Demonstration& demonstration, const std::filesystem::path& run,
          TrainOptions& options);
Demonstration load_run_demonstration(const TrainOptions& options, const std::filesystem::path& run);

}  // namespace stride::training
