#pragma once

// C++17-clean and free of Eigen: the Simbody engine includes it.

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stride::osim {

using Vec3 = std::array<double, 3>;

/// OpenSim's SimmSpline: a cubic spline through (x, y) with SIMM's end conditions, linear outside.
/// A single value is a constant; two points are a line.
struct SimmSpline {
  std::vector<double> x, y;
};

struct Coordinate {
  std::string name;
  bool rotational = true;  // rad, else m
  double default_value = 0, default_speed = 0;
  double range_min = -10, range_max = 10;  // rad or m; clamps moving path points, not the motion
  bool clamped = false, locked = false;
};

struct Body {
  std::string name;
  double mass_kg = 0;
  Vec3 mass_center_m{};             // in the body's frame
  std::array<double, 6> inertia{};  // kg·m² about the mass centre: xx yy zz xy xz yz
};

/// One axis of a CustomJoint's SpatialTransform: displacement along or about `axis` =
/// function(coordinate).
struct TransformAxis {
  enum class Kind { constant, linear, spline };
  Vec3 axis{};
  int coordinate = -1;  // index into Model::coordinates; -1: none
  Kind kind = Kind::constant;
  double constant = 0;              // kind constant
  double slope = 0, intercept = 0;  // kind linear: slope · q + intercept
  SimmSpline spline;                // kind spline
};

struct Joint {
  enum class Type {
    planar,
    pin,
    custom,
    weld
  };  // planar: rotation about z, translation x, translation y
  std::string name;
  Type type = Type::weld;
  int parent = -1, child = -1;  // indices into Model::bodies; parent -1: ground
  Vec3 location_in_parent_m{}, orientation_in_parent_rad{};  // body-fixed XYZ Euler angles
  Vec3 location_in_child_m{}, orientation_in_child_rad{};
  std::vector<int> coordinates;              // indices into Model::coordinates
  std::array<TransformAxis, 6> transform{};  // custom only: rotation1‥3, translation1‥3
};

struct PathPoint {
  enum class Kind { fixed, conditional, moving };
  std::string name;
  Kind kind = Kind::fixed;
  int body = -1;        // -1: ground
  Vec3 location_m{};    // fixed, conditional
  int coordinate = -1;  // conditional: present while range_min ≤ q ≤ range_max
  double range_min = 0, range_max = 0;
  std::array<SimmSpline, 3> location{};  // moving: x, y, z against their coordinate
  std::array<int, 3> location_coordinate{-1, -1, -1};
};

/// Thelen2003Muscle. Defaults are OpenSim's property defaults.
struct Muscle {
  std::string name;
  double max_isometric_force_N = 1000;
  double optimal_fiber_length_m = 0.1;
  double tendon_slack_length_m = 0.2;
  double pennation_angle_at_optimal_rad = 0;
  double max_contraction_velocity = 10;  // optimal fibre lengths per second
  double activation_time_constant_s = 0.015, deactivation_time_constant_s = 0.05;
  double minimum_activation = 0.01;
  double FmaxTendonStrain = 0.04, FmaxMuscleStrain = 0.6;
  double KshapeActive = 0.45, KshapePassive = 5, Af = 0.25, Flen = 1.4;
  double fv_linear_extrap_threshold = 0.95;
  double maximum_pennation_angle_rad = 1.4706289056333368;  // acos(0.1)
  std::optional<double> default_fiber_length_m;  // if the file has one; else OpenSim's 0.1 m
  double default_activation = 0.05;
  std::vector<PathPoint> path;
};

struct ContactSphere {
  std::string name;
  int body = -1;
  Vec3 location_m{};
  double radius_m = 0;
};

/// The half-space y ≤ height of the ground. Other orientations are refused.
struct ContactPlane {
  std::string name;
  double height_m = 0;
};

/// HuntCrossleyForce between one plane and spheres, in file order.
struct ContactForce {
  std::string name;
  int plane = -1;            // index into Model::planes
  std::vector<int> spheres;  // indices into Model::spheres
  double stiffness = 1e8, dissipation = 0;
  double static_friction = 0, dynamic_friction = 0, viscous_friction = 0;
  double transition_velocity_m_s = 0.01;
};

/// CoordinateLimitForce; rotations in degrees as in the file.
struct CoordinateLimit {
  std::string name;
  int coordinate = -1;
  double upper_stiffness = 1, upper_limit = 0, lower_stiffness = 1, lower_limit = 0;
  double damping = 0.001, transition = 0.1;
};

/// An OpenSim model as plain data, in file order. SI units and radians, except where OpenSim uses
/// degrees.
struct Model {
  std::string name, credits;
  Vec3 gravity_m_s2{0, -9.80665, 0};
  std::vector<Body> bodies;  // without ground
  std::vector<Coordinate> coordinates;
  std::vector<Joint> joints;  // parents before children
  std::vector<Muscle> muscles;
  std::vector<ContactPlane> planes;
  std::vector<ContactSphere> spheres;
  std::vector<ContactForce> contacts;
  std::vector<CoordinateLimit> limits;

  /// Index by name, -1 if there is none.
  int body(std::string_view name) const;
  int coordinate(std::string_view name) const;
  int muscle(std::string_view name) const;

  /// Of all bodies.
  double mass_kg() const;
};

/// Reads an OpenSim model, document versions 30000 (joints inside bodies) and 40000 (sockets and
/// frames). Throws Error with file, line and element for anything unsupported that would change the
/// motion.
Model load_osim(const std::filesystem::path& file);

/// A readable summary of the model, with units.
std::string describe(const Model& model);

/// `calibrate/models/gait9dof18musc.osim`, the model of "Learning to Run".
std::filesystem::path default_model_file();

}  // namespace stride::osim
