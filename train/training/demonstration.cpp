#include "train/training/demonstration.h"

#include <string>

#include "extract/io/error.h"

namespace stride::training {
namespace fs = std::filesystem;
namespace {

/// NAME.calibrated.csv for NAME.potential.json, as `stride convert` leaves them.
fs::path calibrated_beside(const fs::path& potential) {
  return fs::path(potential).replace_extension().replace_extension(".calibrated.csv");
}

}  // namespace

Demonstration load_demonstration(const fs::path& potential, const fs::path& reference,
                                 const EnvironmentOptions& options) {
  Demonstration demonstration;
  if (!potential.empty()) demonstration.potential = load_potential(potential);
  if (options.reference_share == 0 || (potential.empty() && reference.empty()))
    return demonstration;
  const fs::path file = reference.empty() ? calibrated_beside(potential) : reference;
  require(fs::exists(file),
          "{}: no such file; episodes start on the run of the video (environment.reference_share = "
          "{}): name it with --reference, or say --set environment.reference_share=0",
          file.string(), options.reference_share);
  demonstration.reference = load_calibrated(file);
  return demonstration;
}

void save(const Demonstration& demonstration, const fs::path& run, TrainOptions& options) {
  options.shaping.potential = demonstration.potential ? "potential.json" : "";
  options.environment.reference = demonstration.reference ? "reference.calibrated.csv" : "";
  if (!demonstration.reference) options.environment.reference_share = 0;
  if (demonstration.potential) save(*demonstration.potential, run / options.shaping.potential);
  if (demonstration.reference) save(*demonstration.reference, run / options.environment.reference);
}

Demonstration load_run_demonstration(const TrainOptions& options, const fs::path& run) {
  Demonstration demonstration;
  if (!options.environment.reference.empty())
    demonstration.reference = load_calibrated(run / options.environment.reference);
  const ShapingOptions& shaping = options.shaping;
  if (shaping.potential.empty()) return demonstration;
  Potential& potential = demonstration.potential.emplace(load_potential(run / shaping.potential));
  potential.weight *= shaping.scale;
  if (shaping.epsilon_m >= 0) potential.epsilon_m = shaping.epsilon_m;
  if (!shaping.function.empty()) potential.function = inverse_distance(shaping.function);
  if (!shaping.index.empty())
    potential.index = shaping.index == "nearest" ? PotentialIndex::nearest : PotentialIndex::time;
  return demonstration;
}

}  // namespace stride::training
