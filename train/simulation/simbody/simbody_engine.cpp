#include "train/simulation/simbody/simbody_engine.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "train/simulation/integration/merson.h"
#include "train/simulation/laws/placed_runner.h"
#include "train/simulation/laws/runner_forces.h"
#include "train/simulation/simbody/simbody_skeleton.h"

namespace stride::simbody {
namespace {

constexpr int kStates =
    2 * simulation::kCoordinates + 2 * simulation::kMuscles;  // q, u, activations, fibre lengths
using States = std::array<double, kStates>;
constexpr int kU = simulation::kCoordinates, kActivation = 2 * simulation::kCoordinates,
              kFiber = kActivation + simulation::kMuscles;

class SimbodyEngine final : public simulation::Engine {
 public:
  SimbodyEngine(const osim::Model& model, const simulation::EngineOptions& options);

  std::string_view name() const override { return "simbody"; }
  const osim::Model& model() const override { return model_; }
  void set_state(const simulation::RunnerState& state) override;
  const simulation::RunnerState& state() const override { return state_; }
  void set_strength(int muscle, double factor) override { forces_.set_strength(muscle, factor); }
  void set_obstacles(const std::vector<simulation::Obstacle>& all) override {
    forces_.set_obstacles(all);
  }
  void equilibrate_fibers() override;
  simulation::AdvanceReport advance(const simulation::Excitations& excitations,
                                    double duration_s) override;
  simulation::RunnerDerivative derivative(const simulation::Excitations& excitations) override;
  simulation::RunnerKinematics kinematics() override;
  std::array<double, simulation::kCoordinates * simulation::kCoordinates> mass_matrix() override;

 private:
  void place(const double* q, const double* u);
  void apply(const laws::RunnerForces::Result& forces);
  void evaluate(const States& y, const simulation::Excitations& excitations, States& rate);
  States pack() const;
  void unpack(const States& y);

  osim::Model model_;
  simulation::EngineOptions options_;
  simulation::RunnerLayout layout_;
  SimbodySkeleton skeleton_;
  laws::RunnerForces forces_;
  integration::MersonIntegrator<kStates> integrator_;
  simulation::RunnerState state_;
  laws::PlacedRunner runner_;  // of the last place()
  SimTK::Vector mobility_forces_, udot_;
  SimTK::Vector_<SimTK::SpatialVec> body_forces_, accelerations_;
};

SimbodyEngine::SimbodyEngine(const osim::Model& model, const simulation::EngineOptions& options)
    : model_(model),
      options_(options),
      layout_(simulation::runner_layout(model)),
      skeleton_(model_, layout_),
      forces_(model_, layout_, options),
      state_(simulation::default_state(model)) {
  for (const osim::Coordinate& each : model_.coordinates) runner_.q.push_back(each.default_value);
  runner_.u.resize(model_.coordinates.size());
  runner_.frames.resize(model_.bodies.size());
  mobility_forces_.resize(simulation::kCoordinates);
  udot_.resize(simulation::kCoordinates);
  body_forces_.resize(skeleton_.matter.getNumBodies());
  accelerations_.resize(skeleton_.matter.getNumBodies());
}

void SimbodyEngine::set_state(const simulation::RunnerState& state) {
  state_ = state;
  integrator_.restart();
}

void SimbodyEngine::equilibrate_fibers() {
  place(state_.q.data(), state_.u.data());
  for (int i = 0; i < simulation::kMuscles; ++i)
    state_.fiber_length_m[i] = laws::equilibrium_fiber_length(
        forces_.muscle_law(i), state_.activation[i], forces_.muscle_length(i, runner_));
  integrator_.restart();
}

/// Moves Simbody's bodies to q and u (in the runner's order) and reads every body's frame.
void SimbodyEngine::place(const double* q, const double* u) {
  SimTK::State& s = skeleton_.state;
  double* all_q = &s.updQ()[0];
  double* all_u = &s.updU()[0];
  for (int i = 0; i < simulation::kCoordinates; ++i) {
    all_q[skeleton_.slot[i]] = runner_.q[layout_.coordinate[i]] = q[i];
    all_u[skeleton_.slot[i]] = runner_.u[layout_.coordinate[i]] = u[i];
  }
  skeleton_.system.realize(s, SimTK::Stage::Velocity);
  for (std::size_t i = 0; i < runner_.frames.size(); ++i) {
    const SimbodySkeleton::Placement& at = skeleton_.bodies[i];
    laws::BodyFrame& frame = runner_.frames[i];
    if (at.leader < 0) {
      const SimTK::MobilizedBody& root = skeleton_.matter.getMobilizedBody(at.root);
      const SimTK::Transform& x = root.getBodyTransform(s);
      const SimTK::SpatialVec& v = root.getBodyVelocity(s);
      frame = {{x.p()[0], x.p()[1], x.p()[2]}, x.R()[0][0], x.R()[1][0], v[1][0], v[1][1], v[0][2]};
      continue;
    }
    const laws::BodyFrame& leader = runner_.frames[at.leader];
    const double x = leader.cos * at.x - leader.sin * at.y,
                 y = leader.sin * at.x + leader.cos * at.y;
    frame.origin_m = {leader.origin_m[0] + x, leader.origin_m[1] + y, leader.origin_m[2] + at.z};
    frame.cos = leader.cos * at.cos - leader.sin * at.sin;
    frame.sin = leader.sin * at.cos + leader.cos * at.sin;
    frame.vx_m_s = leader.vx_m_s - leader.omega_rad_s * y;
    frame.vy_m_s = leader.vy_m_s + leader.omega_rad_s * x;
    frame.omega_rad_s = leader.omega_rad_s;
  }
}

void SimbodyEngine::apply(const laws::RunnerForces::Result& forces) {
  SimTK::SpatialVec* on_body = &body_forces_[0];
  std::fill(on_body, on_body + body_forces_.size(), SimTK::SpatialVec(SimTK::Vec3(0)));
  for (std::size_t i = 0; i < forces.on_body.size(); ++i) {
    const laws::RunnerForces::Wrench& wrench = forces.on_body[i];
    const SimbodySkeleton::Placement& at = skeleton_.bodies[i];
    double moment = wrench.moment_Nm;
    if (at.leader >= 0) {  // about the leader's origin
      const osim::Vec3 &here = runner_.frames[i].origin_m,
                       &there = runner_.frames[at.leader].origin_m;
      moment += (here[0] - there[0]) * wrench.fy_N - (here[1] - there[1]) * wrench.fx_N;
    }
    SimTK::SpatialVec& sum = on_body[at.root];
    sum[0][2] += moment;
    sum[1][0] += wrench.fx_N;
    sum[1][1] += wrench.fy_N;
  }
  for (int i = 0; i < simulation::kCoordinates; ++i)
    mobility_forces_[skeleton_.slot[i]] = forces.on_coordinate[layout_.coordinate[i]];
}

void SimbodyEngine::evaluate(const States& y, const simulation::Excitations& excitations,
                             States& rate) {
  place(y.data(), y.data() + kU);
  const laws::RunnerForces::Result& forces =
      forces_.evaluate(runner_, y.data() + kActivation, y.data() + kFiber);
  apply(forces);
  skeleton_.system.realize(skeleton_.state, SimTK::Stage::Dynamics);
  skeleton_.matter.calcAccelerationIgnoringConstraints(skeleton_.state, mobility_forces_,
                                                       body_forces_, udot_, accelerations_);
  const double* udot = &udot_[0];
  for (int i = 0; i < simulation::kCoordinates; ++i) {
    rate[i] = y[kU + i];
    rate[kU + i] = udot[skeleton_.slot[i]];
  }
  for (int i = 0; i < simulation::kMuscles; ++i) {
    rate[kActivation + i] =
        laws::activation_rate(forces_.muscle_law(i), y[kActivation + i], excitations[i]);
    rate[kFiber + i] = forces.fiber_velocity_m_s[i];
  }
}

States SimbodyEngine::pack() const {
  States y;
  std::copy(state_.q.begin(), state_.q.end(), y.begin());
  std::copy(state_.u.begin(), state_.u.end(), y.begin() + kU);
  std::copy(state_.activation.begin(), state_.activation.end(), y.begin() + kActivation);
  std::copy(state_.fiber_length_m.begin(), state_.fiber_length_m.end(), y.begin() + kFiber);
  return y;
}

void SimbodyEngine::unpack(const States& y) {
  std::copy_n(y.begin(), simulation::kCoordinates, state_.q.begin());
  std::copy_n(y.begin() + kU, simulation::kCoordinates, state_.u.begin());
  std::copy_n(y.begin() + kActivation, simulation::kMuscles, state_.activation.begin());
  std::copy_n(y.begin() + kFiber, simulation::kMuscles, state_.fiber_length_m.begin());
}

simulation::AdvanceReport SimbodyEngine::advance(const simulation::Excitations& excitations,
                                                 double duration_s) {
  States y = pack();
  // Errors of fibres are relative to their optimal lengths; those of coordinates and speeds are
  // absolute.
  const auto error_of = [&](const States& difference) {
    double largest = 0;
    for (int i = 0; i < kStates; ++i) {
      const double unit = i < kFiber ? 1 : forces_.muscle_law(i - kFiber).optimal_length_m;
      largest = std::max(largest, std::abs(difference[i]) / unit);
    }
    return largest;
  };
  const auto rate = [&](const States& at, States& result) {
    if (std::all_of(at.begin(), at.end(), [](double x) { return std::isfinite(x); }))
      evaluate(at, excitations, result);
    else
      result.fill(std::nan(""));
  };
  simulation::AdvanceReport report;
  try {
    report = integrator_.advance(y, duration_s, options_, rate, error_of);
  } catch (const std::exception& simbodys) {  // Simbody's own error about a state
    report.ok = false;
    report.failure = simbodys.what();
  }
  unpack(y);
  if (report.ok) state_.time_s += duration_s;
  if (!report.ok) integrator_.restart();
  return report;
}

simulation::RunnerDerivative SimbodyEngine::derivative(const simulation::Excitations& excitations) {
  States rate;
  evaluate(pack(), excitations, rate);
  simulation::RunnerDerivative result;
  std::copy_n(rate.begin() + kU, simulation::kCoordinates, result.udot.begin());
  std::copy_n(rate.begin() + kActivation, simulation::kMuscles, result.activation_rate.begin());
  std::copy_n(rate.begin() + kFiber, simulation::kMuscles, result.fiber_velocity_m_s.begin());
  return result;
}

simulation::RunnerKinematics SimbodyEngine::kinematics() {
  place(state_.q.data(), state_.u.data());
  const laws::RunnerForces::Result& forces =
      forces_.evaluate(runner_, state_.activation.data(), state_.fiber_length_m.data());
  simulation::RunnerKinematics k;
  double mass = 0;
  for (int i = 0; i < static_cast<int>(runner_.frames.size()); ++i) {
    const laws::BodyFrame& frame = runner_.frames[i];
    k.bodies.push_back({{frame.origin_m[0], frame.origin_m[1]},
                        {frame.vx_m_s, frame.vy_m_s},
                        std::atan2(frame.sin, frame.cos),
                        frame.omega_rad_s});
    const osim::Body& body = model_.bodies[i];
    const osim::Vec3 com = runner_.point(i, body.mass_center_m);
    const simulation::PlanarVector velocity = runner_.velocity(i, com);
    mass += body.mass_kg;
    k.com.x += body.mass_kg * com[0], k.com.y += body.mass_kg * com[1];
    k.com_velocity.x += body.mass_kg * velocity.x, k.com_velocity.y += body.mass_kg * velocity.y;
  }
  k.energy_J = skeleton_.matter.calcKineticEnergy(skeleton_.state) -
               k.com.x * model_.gravity_m_s2[0] - k.com.y * model_.gravity_m_s2[1];
  k.com = {k.com.x / mass, k.com.y / mass};
  k.com_velocity = {k.com_velocity.x / mass, k.com_velocity.y / mass};
  k.muscle_length_m = forces.muscle_length_m;
  k.tendon_force_N = forces.tendon_force_N;
  k.ground_reaction_N = forces.ground_reaction_N;
  k.limit_torque_Nm = forces.limit_torque_Nm;
  return k;
}

std::array<double, simulation::kCoordinates * simulation::kCoordinates>
SimbodyEngine::mass_matrix() {
  place(state_.q.data(), state_.u.data());
  SimTK::Matrix m;
  skeleton_.matter.calcM(skeleton_.state, m);
  std::array<double, simulation::kCoordinates * simulation::kCoordinates> result;
  for (int i = 0; i < simulation::kCoordinates; ++i)
    for (int j = 0; j < simulation::kCoordinates; ++j)
      result[i * simulation::kCoordinates + j] = m(skeleton_.slot[i], skeleton_.slot[j]);
  return result;
}

}  // namespace

std::unique_ptr<simulation::Engine> make_simbody_engine(const osim::Model& model,
                                                        const simulation::EngineOptions& options) {
  return std::make_unique<SimbodyEngine>(model, options);
}

bool simbody_engine_defines_ndebug() {
#ifdef NDEBUG
  return true;
#else
  return false;
#endif
}

}  // namespace stride::simbody
