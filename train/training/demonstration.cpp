#include "train/training/demonstration.h"

#include <string>

#include "calibrate/osim/model.h"
#include "extract/io/error.h"
#include "extract/skeleton/movement.h"

namespace stride::training {
namespace fs = std::filesystem;
namespace {

/// NAME.calibrated.csv for NAME.potential.json, as `stride convert` leaves them.
fs::path calibrated_beside(const fs::path& potential) {
  return fs::path(potential).replace_extension().replace_extension(".calibrated.csv");
}

/// A task and a demonstration that go together begin and end alike, and mirror alike.
void require_movement(const std::string& name, const std::string& of_task,
                      const std::string& file) {
  const Movement &shown = movement(name), &wanted = movement(of_task);
  require(
      shown.repeats == wanted.repeats,
      "{}: is of the movement {}, which {}; {}, whose task the agent is given, {}: name another "
      "--movement, or the potential of another clip",
      file, shown.name, shown.repeats ? "repeats" : "has a beginning and an end", wanted.name,
      wanted.repeats ? "repeats" : "has a beginning and an end");
}

void require_model(const Potential& p, const std::string& file, const std::string& model_file) {
  const osim::Model model =
      osim::load_osim(model_file.empty() ? osim::default_model_file() : fs::path(model_file));
  require(p.model.empty() || p.model == model.name,
          "{}: was made on the model {}, the run trains {}; convert the clip again with --model",
          file, p.model, model.name);
}

/// The weight with which Φ of the demonstrated motion is higher in its own time than at any other
/// by that share of the reward of a stride at the demonstrated speed.
void weigh_by_strides(const TrainOptions& options, Potential& potential) {
  require(potential.speed_m_s > 0,
          "shaping.stride_share: the potential does not know the speed of its clip; use "
          "shaping.scale");
  const double stride_m = potential.speed_m_s * potential.period_s;
  const double reward_per_m = options.run.learner == "ddpg" ? options.reward.scale : 1;
  potential.weight = 1;
  const double contrast = potential.contrast();
  require(contrast > 0, "shaping.stride_share: the potential's keyframes are all the same");
  potential.weight = options.shaping.stride_share * stride_m * reward_per_m / contrast;
}

}  // namespace

Demonstration load_demonstration(const fs::path& potential, const fs::path& reference,
                                 const EnvironmentOptions& options) {
  Demonstration demonstration;
  if (!potential.empty()) {
    demonstration.potential = load_potential(potential);
    require_human(*demonstration.potential, potential.string());
    require_movement(demonstration.potential->movement, options.task.movement, potential.string());
    require_model(*demonstration.potential, potential.string(), options.model);
  }
  const bool imitates = options.imitation.reward_per_s > 0;
  require(!imitates || !potential.empty() || !reference.empty(),
          "imitation.reward_per_s: needs the clip's run: --potential, or --reference");
  if ((options.reference_share == 0 && !imitates) || (potential.empty() && reference.empty()))
    return demonstration;
  const fs::path file = reference.empty() ? calibrated_beside(potential) : reference;
  require(fs::exists(file),
          "{}: no such file; episodes start on the run of the video (environment.reference_share = "
          "{}): name it with --reference, or say --set environment.reference_share=0{}",
          file.string(), options.reference_share,
          imitates ? " --set imitation.reward_per_s=0" : "");
  demonstration.reference = load_calibrated(file);
  require_movement(demonstration.reference->movement, options.task.movement, file.string());
  return demonstration;
}

void name_copies(const Demonstration& demonstration, TrainOptions& options) {
  options.shaping.potential = demonstration.potential ? "potential.json" : "";
  options.environment.reference = demonstration.reference ? "reference.calibrated.csv" : "";
  if (!demonstration.reference) options.environment.reference_share = 0;
}

void save(const Demonstration& demonstration, const fs::path& run, TrainOptions& options) {
  name_copies(demonstration, options);
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
  potential.velocity_s = shaping.velocity_s;
  potential.angle_m = shaping.angle_m;
  if (!shaping.function.empty()) potential.function = inverse_distance(shaping.function);
  if (!shaping.index.empty()) potential.index = potential_index(shaping.index);
  if (shaping.stride_share > 0) weigh_by_strides(options, potential);
  return demonstration;
}

}  // namespace stride::training
