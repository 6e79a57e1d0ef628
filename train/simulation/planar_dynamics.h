#pragma once

#include <array>
#include <vector>

#include "train/simulation/engine.h"
#include "train/simulation/planar_model.h"

namespace stride {

struct PlanarLinear;

/// Equations of motion of a PlanarModel: one evaluation takes poses, speeds, activations and fibre
/// lengths to accelerations and fibre velocities, without a branch that depends on more than which
/// laws are at work, and without allocating. See README.md for the equations.
class PlanarDynamics {
 public:
  static constexpr int kGroups = PlanarModel::kMuscleGroups;
  using Fibers = std::array<simd::V4, kGroups>;

  /// Poses, speeds and fibre lengths, or their rates, interleaved as in PlanarModel: three vectors
  /// of coordinates, three of speeds, five of fibres. Lanes beyond the last of each are zero.
  struct State {
    static constexpr int kU = 3, kFiber = 6, kSize = 11;
    std::array<simd::V4, kSize> y{};

    double q(int i) const { return y[i / 4][i % 4]; }
    double u(int i) const { return y[kU + i / 4][i % 4]; }
    void set_q(int i, double value) { y[i / 4][i % 4] = value; }
    void set_u(int i, double value) { y[kU + i / 4][i % 4] = value; }
    /// Of hip, knee or ankle.
    simd::V2 joint_q(int j) const { return simd::V2{q(2 * j), q(2 * j + 1)}; }
    simd::V2 joint_u(int j) const { return simd::V2{u(2 * j), u(2 * j + 1)}; }
  };
  /// What an evaluation leaves behind for observers.
  struct Forces {
    Fibers tendon_N{}, path_m{};
    std::array<Planar, PlanarModel::kLegs> ground_N{};
  };

  PlanarDynamics(PlanarModel model, const EngineOptions& options);

  const PlanarModel& model() const { return model_; }
  void set_strength(int interleaved_muscle, double factor);
  void set_obstacles(const std::vector<Obstacle>& obstacles);

  /// Which conditional path points are present is a discrete state, frozen while a step of the
  /// integration runs: one number a muscle and leg, an index into MusclePath::variants.
  using Modes =
      std::array<std::array<unsigned char, PlanarModel::kLegs>, PlanarModel::kMusclesOfLeg>;
  Modes modes_at(const State& state) const;
  void set_modes(const Modes& modes) { modes_ = modes; }
  const Modes& modes() const { return modes_; }

  /// Sets `linear`, if given, to the stiff part of the equations at this state.
  void evaluate(const State& state, const Fibers& activation, State& rate,
                PlanarLinear* linear = nullptr);
  const Forces& forces() const { return forces_; }

  /// Rates of the raw activations.
  Fibers activation_rate(const Fibers& activation, const Fibers& excitation) const;

  /// Pose and velocity of each leg's segments in the ground; the first is the base.
  using Frames =
      std::array<std::array<RunnerKinematics::Frame, PlanarModel::kSegments>, PlanarModel::kLegs>;
  Frames frames(const State& state);

  /// The 9×9 mass matrix, row by row, in interleaved order.
  std::array<double, 81> mass_matrix(const State& state);

 private:
  struct Kinematics;
  struct Legs;
  /// Moment arms about hip, knee, ankle: how much a path lengthens with the angle.
  using Arms = std::array<std::array<simd::V2, 3>, PlanarModel::kMusclesOfLeg>;
  void place(const State& state, Kinematics& k);
  void measure_paths(const Kinematics& k, Arms& arms,
                     std::array<simd::V2, PlanarModel::kMusclesOfLeg + 1>& lengths) const;
  void pull_muscles(const State& state, const Fibers& activation, const Kinematics& k, State& rate,
                    std::array<simd::V2, 3>& torque, PlanarLinear* linear);
  void touch(const State& state, const Kinematics& k, simd::V2& fx, simd::V2& fy, simd::V2& moment,
             PlanarLinear* linear);
  void touch_obstacles(const State& state, const Kinematics& k, simd::V2& fx, simd::V2& fy,
                       simd::V2& moment, PlanarLinear* linear) const;
  void assemble(const Kinematics& k, Legs& legs) const;

  PlanarModel model_;
  bool drop_contacts_, nominal_obstacles_;
  Fibers max_force_N_;
  struct Sphere {
    double x_m, y_m, radius_m;
    ContactLaw law;
  };
  std::vector<Sphere> obstacles_;
  Modes modes_{};
  std::array<int, PlanarModel::kLegs> interval_{};  // of the knee table, where it was last
  Forces forces_;
};

}  // namespace stride
