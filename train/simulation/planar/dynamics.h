#pragma once

#include <array>
#include <vector>

#include "train/simulation/engine/engine.h"
#include "train/simulation/planar/kinematics.h"
#include "train/simulation/planar/planar_contact.h"
#include "train/simulation/planar/planar_model.h"
#include "train/simulation/planar/state.h"

namespace stride::planar {

struct PlanarLinear;

/// Equations of motion of a PlanarModel: one evaluation takes poses, speeds, activations and fibre
/// lengths to accelerations and fibre velocities. It does not allocate, and branches only on which
/// contacts, limits and path points are active. ../README.md has the equations by number.
class PlanarDynamics {
 public:
  static constexpr int kGroups = PlanarModel::kMuscleGroups;
  using Fibers = PlanarFibers;
  using State = PlanarState;

  /// By-products of an evaluation, for observers.
  struct Forces {
    Fibers tendon_N{}, path_m{};
    std::array<simulation::PlanarVector, PlanarModel::kLegs> ground_N{};
  };

  PlanarDynamics(PlanarModel model, const simulation::EngineOptions& options);

  const PlanarModel& model() const { return model_; }
  void set_strength(int interleaved_muscle, double factor);
  void set_obstacles(const std::vector<simulation::Obstacle>& obstacles);

  /// The set of conditional path points that are present, one index into MusclePath::variants for
  /// each muscle and leg. It is a discrete state, frozen during a step of the integration.
  using Modes =
      std::array<std::array<unsigned char, PlanarModel::kLegs>, PlanarModel::kMusclesOfLeg>;
  Modes modes_at(const State& state) const;
  void set_modes(const Modes& modes);
  const Modes& modes() const { return modes_; }

  /// If `linear` is given, sets it to the stiff part of the equations at this state.
  void evaluate(const State& state, const Fibers& activation, State& rate,
                PlanarLinear* linear = nullptr);
  const Forces& forces() const { return forces_; }

  /// Rates of the raw activations.
  Fibers activation_rate(const Fibers& activation, const Fibers& excitation) const;

  /// Pose and velocity of each leg's segments in the ground; segment 0 is the base.
  using Frames = std::array<std::array<simulation::RunnerKinematics::Frame, PlanarModel::kSegments>,
                            PlanarModel::kLegs>;
  Frames frames(const State& state);

  /// The 9×9 mass matrix, row by row, in interleaved order.
  std::array<double, 81> mass_matrix(const State& state);

 private:
  void choose_paths();
  /// Moment arms ∂L/∂q about hip, knee, ankle, m.
  using Arms = std::array<std::array<simd::V2, 3>, PlanarModel::kMusclesOfLeg>;
  void measure_paths(const PlanarKinematics& k, Arms& arms,
                     std::array<simd::V2, PlanarModel::kMusclesOfLeg + 1>& lengths) const;
  void pull_muscles(const State& state, const Fibers& activation, const PlanarKinematics& k,
                    State& rate, std::array<simd::V2, 3>& torque, PlanarLinear* linear);
  void push_limits(const State& state, std::array<simd::V2, 3>& torque, PlanarLinear* linear) const;

  /// PlanarModel::Path of the current modes, both legs in lanes.
  struct Piece {
    std::array<int, PlanarModel::kLegs> inner{}, outer{};
    simd::V2 dz_m{}, weight{}, crosses[PlanarModel::kJoints]{}, moves{};
  };
  struct Path {
    simd::V2 constant_m{};
    std::array<Piece, 2> pieces;
  };

  PlanarModel model_;
  double dropped_;  // share of the force of a contact after one that pulls
  bool nominal_obstacles_;
  Fibers max_force_N_;
  std::vector<PlanarObstacle> obstacles_;
  Modes modes_{};
  std::array<Path, PlanarModel::kMusclesOfLeg> paths_;
  KneeIntervals interval_{};
  Forces forces_;
};

}  // namespace stride::planar
