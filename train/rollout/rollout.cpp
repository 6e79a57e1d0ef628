#include "train/rollout/rollout.h"

#include <fmt/format.h>

#include <algorithm>

#include "extract/io/error.h"
#include "train/rollout/gait.h"
#include "train/simulation/engine/runner_layout.h"

namespace stride::rollout {
namespace {

/// The body whose origin is a part of the runner.
int body_of(BodyPart part, const osim::Model& model) {
  switch (part) {
    case BodyPart::pelvis:
      return model.body("pelvis");
    case BodyPart::knee_r:
      return model.body("tibia_r");
    case BodyPart::knee_l:
      return model.body("tibia_l");
    case BodyPart::ankle_r:
      return model.body("talus_r");
    case BodyPart::ankle_l:
      return model.body("talus_l");
    case BodyPart::toe_r:
      return model.body("toes_r");
    case BodyPart::toe_l:
      return model.body("toes_l");
    case BodyPart::hip_r:
      return model.body("femur_r");
    case BodyPart::hip_l:
      return model.body("femur_l");
    case BodyPart::head:
      return model.body("head");
  }
  return -1;
}

/// The head of OpenSim's storage format.
std::string storage_head(const char* name, std::size_t rows, std::size_t columns) {
  return fmt::format(
      "{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees=no\nWritten by stride. SI units, rad.\n"
      "endheader\n",
      name, rows, columns);
}

}  // namespace

template <typename Scalar>
Rollout record_episode(const network::Policy<Scalar>& policy,
                       environment::RunnerEnvironment& environment, environment::Observer& observer,
                       const Potential* potential, int action_repeat, std::uint64_t seed) {
  Rollout rollout;
  const auto keep = [&](const Eigen::VectorXd& action) {
    RolloutFrame frame{.state = environment.engine().state(),
                       .kinematics = environment.kinematics()};
    std::copy(action.begin(), action.end(), frame.excitations.begin());
    if (potential != nullptr)
      frame.phase = environment.initial_phase() + potential->phase_at(environment.time_s());
    rollout.frames.push_back(std::move(frame));
  };
  rollout.summary =
      network::run_episode(policy, environment, observer, potential, action_repeat, seed, keep);
  rollout.obstacles = environment.scene().obstacles;
  return rollout;
}

CalibratedTrajectory demonstration(const Rollout& rollout, const osim::Model& model,
                                   double from_s) {
  std::vector<double> strikes;  // of the right foot
  for (const FootContact& contact : foot_contacts(rollout, model))
    if (contact.side == 0 && contact.start_s >= from_s) strikes.push_back(contact.start_s);
  require(strikes.size() >= 3,
          "the runner takes {} strides after {} s: a demonstration needs two; train longer, or "
          "choose an earlier --from",
          strikes.empty() ? 0 : strikes.size() - 1, from_s);
  CalibratedTrajectory run;
  run.model = model.name;
  run.period_s = (strikes.back() - strikes.front()) / static_cast<double>(strikes.size() - 1);
  const auto pelvis = static_cast<std::size_t>(model.body("pelvis"));
  for (const RolloutFrame& frame : rollout.frames) {
    const double time = frame.state.time_s;
    if (time < strikes.front() || time > strikes.back()) continue;
    CalibratedSample sample;
    sample.time_s = time;
    const double strides = (time - strikes.front()) / run.period_s;
    sample.phase = strides - std::floor(strides);
    for (std::size_t i = 0; i < kCoordinateNames.size(); ++i)
      sample.coordinates[i] = frame.state.q[i];
    const simulation::Planar origin = frame.kinematics.bodies[pelvis].position;
    for (const BodyPart part : kBodyParts) {
      const simulation::Planar p =
          frame.kinematics.bodies[static_cast<std::size_t>(body_of(part, model))].position;
      sample.p_m[static_cast<std::size_t>(index(part))] = {p.x - origin.x, p.y - origin.y};
    }
    run.samples.push_back(sample);
  }
  run.speed_m_s = (run.samples.back().coordinates[1] - run.samples.front().coordinates[1]) /
                  (run.samples.back().time_s - run.samples.front().time_s);
  return run;
}

std::string motion_file(const Rollout& rollout) {
  std::string text =
      storage_head("Coordinates", rollout.frames.size(), 1 + kCoordinateNames.size());
  text += "time";
  for (const char* name : kCoordinateNames) text += fmt::format("\t{}", name);
  for (const RolloutFrame& frame : rollout.frames) {
    text += fmt::format("\n{:.4f}", frame.state.time_s);
    for (const double q : frame.state.q) text += fmt::format("\t{}", q);
  }
  return text + '\n';
}

std::string states_file(const Rollout& rollout) {
  std::string text =
      storage_head("ModelStates", rollout.frames.size(),
                   1 + 2 * kCoordinateNames.size() + 2 * simulation::muscle_names().size());
  text += "time";
  for (const char* name : kCoordinateNames) text += fmt::format("\t{}\t{}_u", name, name);
  for (const std::string& muscle : simulation::muscle_names())
    text += fmt::format("\t{0}.activation\t{0}.fiber_length", muscle);
  for (const RolloutFrame& frame : rollout.frames) {
    const simulation::RunnerState& state = frame.state;
    text += fmt::format("\n{:.4f}", state.time_s);
    for (std::size_t i = 0; i < state.q.size(); ++i)
      text += fmt::format("\t{}\t{}", state.q[i], state.u[i]);
    for (std::size_t i = 0; i < state.activation.size(); ++i)
      text += fmt::format("\t{}\t{}", state.activation[i], state.fiber_length_m[i]);
  }
  return text + '\n';
}

template Rollout record_episode(const network::Policy<float>&, environment::RunnerEnvironment&,
                                environment::Observer&, const Potential*, int, std::uint64_t);
template Rollout record_episode(const network::Policy<double>&, environment::RunnerEnvironment&,
                                environment::Observer&, const Potential*, int, std::uint64_t);

}  // namespace stride::rollout
