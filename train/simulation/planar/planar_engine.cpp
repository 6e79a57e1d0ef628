#include "train/simulation/planar/planar_engine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/laws/muscle.h"
#include "train/simulation/planar/dynamics.h"
#include "train/simulation/planar/integrator.h"

namespace stride::planar {
namespace {

using State = PlanarDynamics::State;
using Fibers = PlanarDynamics::Fibers;

constexpr int kMusclesOfLeg = PlanarModel::kMusclesOfLeg;

/// Interleaved index of a muscle in the competition's order.
int interleaved(int muscle) { return 2 * (muscle % kMusclesOfLeg) + muscle / kMusclesOfLeg; }

class PlanarEngine final : public simulation::Engine {
 public:
  PlanarEngine(const osim::Model& model, const simulation::EngineOptions& options)
      : model_(model),
        layout_(simulation::runner_layout(model)),
        dynamics_(planar_model(model), options),
        integrator_(options) {
    set_state(simulation::default_state(model));
  }

  std::string_view name() const override { return "planar"; }
  const osim::Model& model() const override { return model_; }
  const simulation::RunnerState& state() const override { return state_; }
  void set_strength(int muscle, double factor) override {
    dynamics_.set_strength(interleaved(muscle), factor);
  }
  void set_obstacles(const std::vector<simulation::Obstacle>& obstacles) override {
    dynamics_.set_obstacles(obstacles);
  }

  void set_state(const simulation::RunnerState& state) override {
    state_ = state;
    y_ = {};
    for (int i = 0; i < simulation::kCoordinates; ++i) {
      y_.set_q(dynamics_.model().coordinate[i], state.q[i]);
      y_.set_u(dynamics_.model().coordinate[i], state.u[i]);
    }
    for (int i = 0; i < simulation::kMuscles; ++i)
      set_muscle(i, state.activation[i], state.fiber_length_m[i]);
    integrator_.restart();
  }

  void equilibrate_fibers() override {
    evaluate();
    for (int i = 0; i < simulation::kMuscles; ++i) {
      const double path = lane(dynamics_.forces().path_m, i);
      state_.fiber_length_m[i] = laws::equilibrium_fiber_length(
          laws::MuscleLaw(model_.muscles[layout_.muscle[i]]), state_.activation[i], path);
      set_muscle(i, state_.activation[i], state_.fiber_length_m[i]);
    }
    integrator_.restart();
  }

  simulation::AdvanceReport advance(const simulation::Excitations& excitations,
                                    double duration_s) override {
    simulation::AdvanceReport report =
        integrator_.advance(dynamics_, y_, activation_, interleave(excitations), duration_s);
    for (int i = 0; i < simulation::kCoordinates; ++i) {
      state_.q[i] = y_.q(dynamics_.model().coordinate[i]);
      state_.u[i] = y_.u(dynamics_.model().coordinate[i]);
    }
    for (int i = 0; i < simulation::kMuscles; ++i) {
      state_.activation[i] = lane(activation_, i);
      state_.fiber_length_m[i] = fiber(y_, i);
    }
    if (report.ok) state_.time_s += duration_s;
    return report;
  }

  simulation::RunnerDerivative derivative(const simulation::Excitations& excitations) override {
    const State rate = evaluate();
    const Fibers activation = dynamics_.activation_rate(activation_, interleave(excitations));
    simulation::RunnerDerivative result;
    for (int i = 0; i < simulation::kCoordinates; ++i) {
      result.udot[i] = rate.u(dynamics_.model().coordinate[i]);
    }
    for (int i = 0; i < simulation::kMuscles; ++i) {
      result.activation_rate[i] = lane(activation, i);
      result.fiber_velocity_m_s[i] = fiber(rate, i);
    }
    return result;
  }

  simulation::RunnerKinematics kinematics() override;

  std::array<double, simulation::kCoordinates * simulation::kCoordinates> mass_matrix() override {
    const std::array<double, 81> m = dynamics_.mass_matrix(y_);
    const std::array<int, simulation::kCoordinates>& c = dynamics_.model().coordinate;
    std::array<double, simulation::kCoordinates * simulation::kCoordinates> result;
    for (int i = 0; i < simulation::kCoordinates; ++i) {
      for (int j = 0; j < simulation::kCoordinates; ++j)
        result[i * simulation::kCoordinates + j] = m[9 * c[i] + c[j]];
    }
    return result;
  }

 private:
  static double lane(const Fibers& fibers, int muscle) {
    const int i = interleaved(muscle);
    return fibers[i / 4][i % 4];
  }
  static double fiber(const State& y, int muscle) {
    const int i = interleaved(muscle);
    return y.y[State::kFiber + i / 4][i % 4];
  }
  /// The two lanes beyond the last muscle repeat it.
  void set_muscle(int muscle, double activation, double length) {
    for (int i = interleaved(muscle); i < 4 * PlanarModel::kMuscleGroups; i += 2) {
      activation_[i / 4][i % 4] = activation;
      y_.y[State::kFiber + i / 4][i % 4] = length;
      if (i < 16) break;
    }
  }
  static Fibers interleave(const simulation::Excitations& excitations) {
    Fibers result{};
    for (int m = 0; m < simulation::kMuscles; ++m) {
      for (int i = interleaved(m); i < 4 * PlanarModel::kMuscleGroups; i += 2) {
        result[i / 4][i % 4] = excitations[m];
        if (i < 16) break;
      }
    }
    return result;
  }
  State evaluate() {
    State rate;
    dynamics_.set_modes(dynamics_.modes_at(y_));
    dynamics_.evaluate(y_, activation_, rate);
    return rate;
  }

  osim::Model model_;
  simulation::RunnerLayout layout_;
  PlanarDynamics dynamics_;
  PlanarIntegrator integrator_;
  simulation::RunnerState state_;
  State y_;
  Fibers activation_{};
};

simulation::RunnerKinematics PlanarEngine::kinematics() {
  evaluate();
  const PlanarModel& m = dynamics_.model();
  const PlanarDynamics::Frames frames = dynamics_.frames(y_);
  simulation::RunnerKinematics k;
  double mass = 0;
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    const PlanarModel::Place& at = m.bodies[b];
    const simulation::RunnerKinematics::Frame& segment = frames[std::max(at.leg, 0)][at.segment];
    const double c = std::cos(segment.angle_rad), s = std::sin(segment.angle_rad);
    const auto point = [&](double x, double y) {  // position and velocity of a point of the segment
      const double dx = c * x - s * y, dy = s * x + c * y;
      return std::pair<simulation::PlanarVector, simulation::PlanarVector>{
          {segment.position.x + dx, segment.position.y + dy},
          {segment.velocity.x - segment.omega_rad_s * dy,
           segment.velocity.y + segment.omega_rad_s * dx}};
    };
    const auto [origin, velocity] = point(at.x_m, at.y_m);
    k.bodies.push_back({origin, velocity, segment.angle_rad + at.angle_rad, segment.omega_rad_s});
    const osim::Body& body = model_.bodies[b];
    const double bc = std::cos(at.angle_rad), bs = std::sin(at.angle_rad);
    const osim::Vec3& com = body.mass_center_m;
    const auto [center, speed] =
        point(at.x_m + bc * com[0] - bs * com[1], at.y_m + bs * com[0] + bc * com[1]);
    mass += body.mass_kg;
    k.com.x += body.mass_kg * center.x, k.com.y += body.mass_kg * center.y;
    k.com_velocity.x += body.mass_kg * speed.x, k.com_velocity.y += body.mass_kg * speed.y;
    k.energy_J += 0.5 * body.mass_kg * (speed.x * speed.x + speed.y * speed.y) +
                  0.5 * body.inertia[2] * segment.omega_rad_s * segment.omega_rad_s -
                  body.mass_kg * (center.x * m.gravity_x + center.y * m.gravity_y);
  }
  k.com = {k.com.x / mass, k.com.y / mass};
  k.com_velocity = {k.com_velocity.x / mass, k.com_velocity.y / mass};
  for (int i = 0; i < simulation::kMuscles; ++i) {
    k.tendon_force_N[i] = lane(dynamics_.forces().tendon_N, i);
    k.muscle_length_m[i] = lane(dynamics_.forces().path_m, i);
  }
  for (int leg = 0; leg < PlanarModel::kLegs; ++leg) {
    if (m.contact_of_leg[leg] < 0) continue;
    k.ground_reaction_N[m.contact_of_leg[leg]] = dynamics_.forces().ground_N[leg];
  }
  for (std::size_t i = 0; i < std::min(m.limits.size(), k.limit_torque_Nm.size()); ++i) {
    const int c = m.limits[i].coordinate;
    k.limit_torque_Nm[i] = laws::limit_force(m.limits[i].law, y_.q(c), y_.u(c));
  }
  return k;
}

}  // namespace

std::unique_ptr<simulation::Engine> make_planar_engine(const osim::Model& model,
                                                       const simulation::EngineOptions& options) {
  return std::make_unique<PlanarEngine>(model, options);
}

}  // namespace stride::planar
