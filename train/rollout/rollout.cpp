#include "train/rollout/rollout.h"

#include <algorithm>

#include "calibrate/osim/storage.h"
#include "extract/io/error.h"
#include "train/rollout/gait_summary.h"
#include "train/simulation/engine/runner_layout.h"

namespace stride::rollout {
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
    const simulation::PlanarVector origin = frame.kinematics.bodies[pelvis].position;
    for (const BodyPart part : kAskedParts) {
      const simulation::PlanarVector p =
          frame.kinematics.bodies[static_cast<std::size_t>(model.body(row(part).osim_body))]
              .position;
      sample.p_m[static_cast<std::size_t>(index(part))] = {p.x - origin.x, p.y - origin.y};
    }
    run.samples.push_back(sample);
  }
  run.speed_m_s = (run.samples.back().coordinates[1] - run.samples.front().coordinates[1]) /
                  (run.samples.back().time_s - run.samples.front().time_s);
  return run;
}

std::string motion_file(const Rollout& rollout) {
  osim::Storage storage{.name = "Coordinates", .columns = {}, .rows = {}};
  storage.columns.assign(kCoordinateNames.begin(), kCoordinateNames.end());
  for (const RolloutFrame& frame : rollout.frames)
    storage.rows.push_back({frame.state.time_s, {frame.state.q.begin(), frame.state.q.end()}});
  return osim::to_text(storage);
}

std::string states_file(const Rollout& rollout) {
  osim::Storage storage{.name = "ModelStates", .columns = {}, .rows = {}};
  for (const std::string name : kCoordinateNames)
    storage.columns.insert(storage.columns.end(), {name, name + "_u"});
  for (const std::string& muscle : simulation::muscle_names())
    storage.columns.insert(storage.columns.end(),
                           {muscle + ".activation", muscle + ".fiber_length"});
  for (const RolloutFrame& frame : rollout.frames) {
    const simulation::RunnerState& state = frame.state;
    osim::Storage::Row& row = storage.rows.emplace_back();
    row.time_s = state.time_s;
    for (std::size_t i = 0; i < state.q.size(); ++i)
      row.values.insert(row.values.end(), {state.q[i], state.u[i]});
    for (std::size_t i = 0; i < state.activation.size(); ++i)
      row.values.insert(row.values.end(), {state.activation[i], state.fiber_length_m[i]});
  }
  return osim::to_text(storage);
}

template Rollout record_episode(const network::Policy<float>&, environment::RunnerEnvironment&,
                                environment::Observer&, const Potential*, int, std::uint64_t);
template Rollout record_episode(const network::Policy<double>&, environment::RunnerEnvironment&,
                                environment::Observer&, const Potential*, int, std::uint64_t);

}  // namespace stride::rollout
