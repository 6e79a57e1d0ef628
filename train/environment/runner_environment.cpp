#include "train/environment/runner_environment.h"

#include <algorithm>
#include <cmath>

#include "extract/io/error.h"
#include "extract/io/random.h"
#include "extract/skeleton/movement.h"
#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/make_engine.h"

namespace stride::environment {
namespace {

simulation::EngineOptions engine_options(const RunnerOptions& options) {
  simulation::EngineOptions engine;
  engine.accuracy = options.accuracy;
  engine = competition::under(options.rules, engine);
  engine.drop_contacts &= options.drop_contacts;
  engine.drop_share = options.drop_share;
  return engine;
}

/// Depth of the feet in the soft ground in quiet standing, m.
constexpr double kStandingDepth_m = 0.025;

double backward_knees_rad(const simulation::RunnerState& state) {
  return std::max(state.q[simulation::kKneeRight], 0.0) +
         std::max(state.q[simulation::kKneeLeft], 0.0);
}

double deepest_contact(const osim::Model& model, const simulation::RunnerKinematics& kinematics) {
  double deepest = 0;
  for (const osim::ContactForce& contact : model.contacts)
    for (int i : contact.spheres) {
      const osim::ContactSphere& sphere = model.spheres[i];
      if (sphere.body < 0) continue;
      const simulation::RunnerKinematics::Frame& frame = kinematics.bodies[sphere.body];
      const double y = frame.position.y + std::sin(frame.angle_rad) * sphere.location_m[0] +
                       std::cos(frame.angle_rad) * sphere.location_m[1];
      deepest = std::max(deepest, model.planes[contact.plane].height_m + sphere.radius_m - y);
    }
  return deepest;
}

}  // namespace

RunnerEnvironment::RunnerEnvironment(const osim::Model& model, const RunnerOptions& options)
    : options_(options),
      engine_(simulation::make_engine(options.engine, model, engine_options(options))),
      task_(task::make_task(options.task, model)),
      sensors_(model),
      robust_features_(model, options.rules),
      legs_together_(movement(options.task.movement).legs == Legs::together),
      knee_r_(model.body("tibia_r")),
      knee_l_(model.body("tibia_l")) {
  competition::check_scene_options(options.difficulty, options.max_obstacles);
  require(options.accuracy > 0 && options.accuracy <= 0.1,
          "accuracy = {}: must be in (0, 0.1]; 1e-3 is usual", options.accuracy);
  require(options.max_steps >= 0, "max_steps = {}: must be > 0, or 0: as the task has it",
          options.max_steps);
  require(options.foot == "ankle" || options.foot == "toe", "foot \"{}\": must be ankle or toe",
          options.foot);
  require(options.backward_knees >= 0, "backward_knees = {}: must be >= 0", options.backward_knees);
  require(options.reference_share >= 0 && options.reference_share <= 1,
          "reference_share = {}: must be in [0, 1]", options.reference_share);
  require(!options.reference || options.reference->samples.size() >= 3,
          "reference {}: has {} samples; speeds need three at least",
          options.reference ? options.reference->source : "",
          options.reference ? options.reference->samples.size() : 0);
  if (options.reference)
    for (const CalibratedSample& sample : options.reference->samples)
      for (double value : sample.coordinates)
        require(std::isfinite(value), "reference {}: at {} s a coordinate is not a number",
                options.reference->source, sample.time_s);
  require(options.imitation.reward_per_s == 0 || options.reference,
          "imitation.reward_per_s = {}: needs the clip's run, NAME.calibrated.csv",
          options.imitation.reward_per_s);
  if (options.imitation.reward_per_s > 0) imitation_.emplace(*options.reference, options.imitation);
  foot_r_ = model.body(options.foot == "toe" ? "toes_r" : "talus_r");
  foot_l_ = model.body(options.foot == "toe" ? "toes_l" : "talus_l");
  spec_.observation_names = competition::Sensors::names();
  spec_.observation_names.insert(spec_.observation_names.end(), RobustFeatures::names().begin(),
                                 RobustFeatures::names().end());
  spec_.action_names.assign(simulation::muscle_names().begin(), simulation::muscle_names().end());
  spec_.step_s = competition::kStep_s;
  spec_.max_steps = options.max_steps > 0
                        ? options.max_steps
                        : static_cast<int>(std::lround(task::time_limit_s(options.task.name) /
                                                       competition::kStep_s));
  step_.observation.resize(static_cast<Eigen::Index>(spec_.observation_names.size()));
}

const Eigen::VectorXd& RunnerEnvironment::reset(std::uint64_t seed) {
  if (running_) ++tally_.abandoned;
  ++tally_.episodes;
  running_ = true;
  steps_ = 0;
  initial_phase_ = 0;
  reward_ = {};
  report_ = {};
  scene_ = competition::draw_scene(seed, options_.difficulty, options_.max_obstacles);
  std::mt19937_64 random(seed);
  thin_out(random);
  competition::arrange(scene_, options_.rules, options_.max_obstacles, *engine_);
  late_positions_.start(seed);
  robust_features_.start();
  if (options_.reference && uniform(random) < options_.reference_share)
    start_on_reference(random);
  else
    competition::set_initial_state(options_.raw_fibres ? options_.rules : competition::Rules::clean,
                                   *engine_);
  kinematics_ = engine_->kinematics();
  task_->start({engine_->state(), kinematics_, reward_});
  observe();
  return step_.observation;
}

void RunnerEnvironment::thin_out(std::mt19937_64& random) {
  if (options_.flat_share + options_.few_share == 0) return;
  constexpr std::size_t kFew = 3;
  const double kind = uniform(random), count = uniform(random);
  if (kind < options_.flat_share)
    scene_.obstacles.clear();
  else if (kind < options_.flat_share + options_.few_share)
    scene_.obstacles.resize(
        std::min(scene_.obstacles.size(), static_cast<std::size_t>(count * (kFew + 1))));
}

void RunnerEnvironment::start_on_reference(std::mt19937_64& random) {
  const std::vector<CalibratedSample>& samples = options_.reference->samples;
  const auto i =
      1 + static_cast<std::size_t>(uniform(random) * static_cast<double>(samples.size() - 2));
  const CalibratedSample &before = samples[i - 1], &now = samples[i], &after = samples[i + 1];
  simulation::RunnerState state = simulation::default_state(engine_->model());
  state.q = now.coordinates;
  for (int k = 0; k < simulation::kCoordinates; ++k)
    state.u[k] = (after.coordinates[k] - before.coordinates[k]) / (after.time_s - before.time_s);
  state.q[simulation::kPelvisX] = 0;
  engine_->set_state(state);
  const double depth = deepest_contact(engine_->model(), engine_->kinematics());
  state.q[simulation::kPelvisY] += std::max(depth - kStandingDepth_m, 0.0);
  engine_->set_state(state);
  engine_->equilibrate_fibers();
  initial_phase_ = now.phase;
}

void RunnerEnvironment::observe() {
  sensors_.read(engine_->state(), kinematics_, scene_, options_.rules, options_.max_obstacles,
                step_.observation.data());
  if (options_.late_positions && options_.rules == competition::Rules::nips2017)
    late_positions_.apply(step_.observation);
  robust_features_.read(step_.observation,
                        step_.observation.data() + competition::Sensors::names().size());
}

const Step& RunnerEnvironment::step(const Eigen::VectorXd& action) {
  simulation::Excitations excitations{};
  bool finite = action.size() == simulation::kMuscles;
  for (int i = 0; i < simulation::kMuscles && finite; ++i) {
    finite = std::isfinite(action[i]);
    excitations[i] = std::clamp(action[i], 0.0, 1.0);
  }
  if (legs_together_)  // one decision for both
    std::copy_n(excitations.begin(), simulation::kMusclesOfLeg,
                excitations.begin() + simulation::kMusclesOfLeg);
  const double x_before = engine_->state().q[simulation::kPelvisX];
  if (finite) {
    report_ = engine_->advance(excitations, competition::kStep_s);
  } else {
    report_ = {};
    report_.ok = false;
    report_.failure = "an excitation is not a finite number";
  }
  ++steps_;
  ++tally_.steps;
  kinematics_ = engine_->kinematics();
  reward_ = competition::step_reward(x_before, engine_->state(), kinematics_);
  observe();
  const task::Outcome outcome = task_->step({engine_->state(), kinematics_, reward_});
  step_.reward = outcome.reward - options_.backward_knees * competition::kStep_s *
                                      backward_knees_rad(engine_->state());
  bool strayed = false;
  if (imitation_) {
    const double phase = imitation_->phase_at(initial_phase_, time_s());
    step_.reward += imitation_->reward(engine_->state(), phase, competition::kStep_s);
    strayed = imitation_->ends(engine_->state(), phase);
  }
  step_.failed = !report_.ok;
  step_.terminated = step_.failed || strayed || outcome.end == task::End::fall;
  step_.truncated =
      !step_.terminated && (outcome.end == task::End::done || steps_ >= spec_.max_steps);
  if (step_.terminated || step_.truncated) {
    running_ = false;
    ++(step_.failed ? tally_.failures : step_.terminated ? tally_.falls : tally_.time_limits);
  }
  return step_;
}

Pose RunnerEnvironment::from_pelvis(simulation::PlanarVector Frame::*what,
                                    const Coordinates& pelvis) const {
  const auto relative = [&](int body) {
    const simulation::PlanarVector& part = kinematics_.bodies[body].*what;
    return Eigen::Vector2d(part.x - pelvis[simulation::kPelvisX],
                           part.y - pelvis[simulation::kPelvisY]);
  };
  Pose pose;
  pose.pelvis_height_m() = pelvis[simulation::kPelvisY];
  pose[PosePart::knee_r] = relative(knee_r_);
  pose[PosePart::knee_l] = relative(knee_l_);
  pose[PosePart::foot_r] = relative(foot_r_);
  pose[PosePart::foot_l] = relative(foot_l_);
  return pose;
}

Pose RunnerEnvironment::pose() const { return from_pelvis(&Frame::position, engine_->state().q); }

Pose RunnerEnvironment::pose_velocity() const {
  return from_pelvis(&Frame::velocity, engine_->state().u);
}

}  // namespace stride::environment
