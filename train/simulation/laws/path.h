#pragma once

// C++17-clean and free of Simbody and Eigen.

#include <array>
#include <vector>

#include "calibrate/osim/model.h"
#include "calibrate/osim/simm_spline.h"

namespace stride::laws {

/// A muscle's path: straight pieces between points on bodies that move in the sagittal plane.
struct PathLaw {
  struct Point {
    osim::PathPoint::Kind kind = osim::PathPoint::Kind::fixed;
    int body = -1;
    osim::Vec3 location_m{};
    int coordinate = -1;  // of Model::coordinates; conditional, moving
    /// Conditional: the range in which it is present, with OpenSim's tolerance of 1e-5. Moving: the
    /// range to which the coordinate is clamped.
    double range_min = 0, range_max = 0;
    std::array<osim::SplineCoefficients, 3> location;  // moving
  };
  std::vector<Point> points;
};

PathLaw path_law(const osim::Model& model, const osim::Muscle& muscle);

/// Pose and velocity of a body's frame in the ground; rotation about z only.
struct BodyFrame {
  osim::Vec3 origin_m{};
  double cos = 1, sin = 0;
  double vx_m_s = 0, vy_m_s = 0, omega_rad_s = 0;
};

/// A path point that is present, in axes of the ground.
struct PathNode {
  int body = -1;
  osim::Vec3 position_m{};
  osim::Vec3 velocity_m_s{};
  osim::Vec3 pull{};    // force on the body for a tension of 1 N, N
  int coordinate = -1;  // of a moving point: the coordinate that moves it in its body
  /// ∂position/∂coordinate of that motion, m/rad. Outside the coordinate's range it is not the
  /// derivative of the position, because OpenSim clamps the angle only for the position.
  osim::Vec3 derivative{};
};

/// Writes the points that are present into `nodes`, which has room for all; returns their number.
/// `q` and `u` in the order of Model::coordinates, `frames` in that of Model::bodies.
int place_path(const PathLaw& path, const double* q, const double* u,
               const std::vector<BodyFrame>& frames, PathNode* nodes);

struct PathSummary {
  double length_m = 0, speed_m_s = 0;  // speed: of lengthening
};

/// Length and speed; sets each node's pull. Pieces within one body exert no force.
PathSummary pull_path(PathNode* nodes, int count);

/// Generalised force of a tension of 1 N on the coordinate that moves `node` in its body.
inline double pull_on_coordinate(const PathNode& node) {
  return node.derivative[0] * node.pull[0] + node.derivative[1] * node.pull[1] +
         node.derivative[2] * node.pull[2];
}

}  // namespace stride::laws
