#pragma once

// C++17-clean and free of Simbody and Eigen.

#include <array>
#include <vector>

#include "train/simulation/engine/engine.h"
#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/laws/contact.h"
#include "train/simulation/laws/limit.h"
#include "train/simulation/laws/muscle.h"
#include "train/simulation/laws/path.h"
#include "train/simulation/laws/placed_runner.h"

namespace stride::laws {

/// All forces on a runner: gravity, muscles, contact, joint limits. For any model in the sagittal
/// plane; the planar engine has its own, faster implementation.
class RunnerForces {
 public:
  /// Throws Error if options.drop_contacts and a contact has other than two spheres.
  RunnerForces(const osim::Model& model, const simulation::RunnerLayout& layout,
               const simulation::EngineOptions& options);

  void set_strength(int muscle, double factor) { muscles_[muscle].strength = factor; }
  void set_obstacles(const std::vector<simulation::Obstacle>& obstacles);

  /// Force and moment on a body in the plane, about the body's origin.
  struct Wrench {
    double moment_Nm = 0, fx_N = 0, fy_N = 0;
  };
  struct Result {
    std::vector<Wrench> on_body;        // in the order of Model::bodies
    std::vector<double> on_coordinate;  // of Model::coordinates, beside what acts on the bodies
    std::array<double, simulation::kMuscles> muscle_length_m{}, tendon_force_N{},
        fiber_velocity_m_s{};
    std::array<simulation::PlanarVector, 2> ground_reaction_N{};
    std::array<double, 6> limit_torque_Nm{};
  };

  /// `activation` and `fiber_length_m` of the eighteen muscles. Valid until the next call.
  const Result& evaluate(const PlacedRunner& runner, const double* activation,
                         const double* fiber_length_m);

  double muscle_length(int muscle, const PlacedRunner& runner);
  const MuscleLaw& muscle_law(int muscle) const { return muscles_[muscle].law; }

 private:
  struct MuscleOfRunner {
    MuscleLaw law;
    PathLaw path;
    double strength = 1;
  };
  struct Foot {
    ContactLaw law;
    double floor_m = 0;
    std::vector<int> spheres;  // indices into Model::spheres
  };
  struct JointLimit {
    LimitLaw law;
    int coordinate = 0;  // of the model
  };
  struct ContactObstacle {
    simulation::Obstacle obstacle;
    ContactLaw law;
  };

  void push(const PlacedRunner& runner, int body, const osim::Vec3& point, double fx, double fy);
  void add_gravity(const PlacedRunner& runner);
  void add_muscle(int i, const PlacedRunner& runner, double activation, double fiber_length_m);
  simulation::PlanarVector add_foot(const PlacedRunner& runner, const Foot& foot);
  void add_obstacle(const PlacedRunner& runner, const ContactObstacle& obstacle_contact);

  osim::Model model_;
  simulation::EngineOptions options_;
  std::vector<MuscleOfRunner> muscles_;
  std::vector<Foot> feet_;
  std::vector<JointLimit> joint_limits_;
  std::vector<ContactObstacle> contact_obstacles_;
  std::vector<PathNode> nodes_;  // room for the longest path
  Result result_;
};

}  // namespace stride::laws
