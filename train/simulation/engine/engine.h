#pragma once

// C++17-clean and free of Simbody and Eigen.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/osim/model.h"

namespace stride::simulation {

/// The runner's coordinates in the order of RunnerState::q. Angles in rad; x is the way of running,
/// y up, m.
enum CoordinateIndex : int {
  kPelvisTilt,
  kPelvisX,
  kPelvisY,
  kHipRight,
  kKneeRight,
  kAnkleRight,
  kHipLeft,
  kKneeLeft,
  kAnkleLeft
};
inline constexpr int kCoordinates = kAnkleLeft + 1;
/// Of a leg, and of the runner: first the right leg, then the left, in the competition's order.
inline constexpr int kMusclesOfLeg = 9, kMuscles = 2 * kMusclesOfLeg;

using Excitations = std::array<double, kMuscles>;

/// The state of the dynamics. rad, m, s; activation is the raw state, which may be below 0.01.
struct RunnerState {
  double time_s = 0;
  std::array<double, kCoordinates> q{}, u{};
  std::array<double, kMuscles> activation{}, fiber_length_m{};
};

/// Time derivatives of a RunnerState; q̇ = u.
struct RunnerDerivative {
  std::array<double, kCoordinates> udot{};
  std::array<double, kMuscles> activation_rate{}, fiber_velocity_m_s{};
};

struct PlanarVector {
  double x = 0, y = 0;
};

/// Quantities computed from a state: origins of bodies in the ground (m, m/s), forces (N, N·m).
struct RunnerKinematics {
  struct Frame {
    PlanarVector position, velocity;
    double angle_rad = 0, omega_rad_s = 0;  // about z
  };
  std::vector<Frame> bodies;  // in the order of Model::bodies
  PlanarVector com, com_velocity;
  std::array<double, kMuscles> tendon_force_N{}, muscle_length_m{};
  std::array<PlanarVector, 2> ground_reaction_N{};  // right foot, left foot: on the foot
  std::array<double, 6> limit_torque_Nm{};          // in the order of Model::limits
  double energy_J = 0;                              // kinetic + gravitational
};

/// A sphere fixed to the ground at z = 0, in frictionless contact with the spheres of the feet.
struct Obstacle {
  double x_m = 0, y_m = 0, radius_m = 0;
};

/// Options of an engine.
struct EngineOptions {
  double accuracy = 1e-3;  // of the error-controlled integration; see the engine
  bool fixed_step = false;
  double fixed_step_s = 2.5e-4;  // used if fixed_step
  /// true: a contact force that would be ≤ 0 drops the remaining contacts of its force element, as
  /// in Simbody's HuntCrossleyForce; false: every contact counts.
  bool drop_contacts = false;
  double drop_share = 1;  // of the force of those, in [0, 1]; less than 1 only to learn by degrees
  /// true: obstacles collide as spheres of 0.1 m with stiffness 1e7, whatever their radius.
  bool nominal_obstacles = false;
  /// Largest number of evaluations in one advance(); beyond it the integration has failed.
  int max_evaluations = 20000;
};

/// Result of one advance(). After a failure the state is the last good one.
struct AdvanceReport {
  bool ok = true;
  int steps = 0, rejected = 0, evaluations = 0;
  std::string failure;  // empty if ok
};

/// The dynamics of one runner. Engines share no state; use one per thread.
class Engine {
 public:
  virtual ~Engine() = default;

  virtual std::string_view name() const = 0;  // "simbody" or "planar"
  virtual const osim::Model& model() const = 0;

  virtual void set_state(const RunnerState& state) = 0;
  virtual const RunnerState& state() const = 0;

  /// Scales the maximum isometric force of a muscle (index in the competition's order).
  virtual void set_strength(int muscle, double factor) = 0;
  virtual void set_obstacles(const std::vector<Obstacle>& obstacles) = 0;

  /// Sets every fibre of the current state to its static equilibrium with the tendon.
  virtual void equilibrate_fibers() = 0;

  /// Advances by duration_s under constant excitations (clipped to [0, 1] by the caller). Never
  /// throws.
  virtual AdvanceReport advance(const Excitations& excitations, double duration_s) = 0;

  /// For the current state.
  virtual RunnerDerivative derivative(const Excitations& excitations) = 0;
  virtual RunnerKinematics kinematics() = 0;

  /// The 9×9 mass matrix of the current state, row by row.
  virtual std::array<double, kCoordinates * kCoordinates> mass_matrix() = 0;
};

}  // namespace stride::simulation
