#pragma once

#include <Simbody.h>

#include <array>
#include <vector>

#include "calibrate/osim/model.h"
#include "calibrate/osim/simm_spline.h"
#include "train/simulation/engine/engine.h"
#include "train/simulation/engine/runner_layout.h"

namespace stride::simbody {

/// A planar joint with one coordinate: angle about z and place of the child in the parent's joint
/// frame, each a function of the coordinate.
class PlanarMotion {
 public:
  /// Throws Error if the joint leaves the sagittal plane.
  PlanarMotion(const osim::Model& model, const osim::Joint& joint);

  struct At {
    osim::SplineValue angle, x, y;
  };
  At at(double q) const;

 private:
  struct Part {
    osim::Vec3 direction{};  // what the function's value adds to: angle, x and y
    osim::TransformAxis axis;
    osim::SplineCoefficients spline;
  };
  std::vector<Part> parts_;
};

/// The bodies of a model as a Simbody system. Bodies that are welded to their parent, or whose
/// coordinates are locked, are one rigid body with it.
class SimbodySkeleton {
 public:
  SimbodySkeleton(const osim::Model& model, const simulation::RunnerLayout& layout);

  /// The pose of a body of Model::bodies: it is a Simbody body, or fixed in a leader that is.
  struct Placement {
    SimTK::MobilizedBodyIndex root{0};
    int leader = -1;                               // index into Model::bodies; -1: itself
    double x = 0, y = 0, z = 0, cos = 1, sin = 0;  // in the leader
  };

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  std::vector<Placement> bodies;
  std::array<int, simulation::kCoordinates>
      slot{};  // of a runner's coordinate among Simbody's q and u
  SimTK::State state;

 private:
  void mobilize(const osim::Model& model, const osim::Joint& joint,
                const SimTK::Transform& parent_in_root, const SimTK::MassProperties& mass);
};

}  // namespace stride::simbody
