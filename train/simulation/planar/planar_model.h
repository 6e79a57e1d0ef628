#pragma once

#include <array>
#include <vector>

#include "calibrate/osim/model.h"
#include "train/simulation/engine/engine.h"
#include "train/simulation/laws/contact.h"
#include "train/simulation/laws/limit.h"
#include "train/simulation/simd/simd.h"

namespace stride::planar {

/// A Model as the planar engine represents it: a base (pelvis, torso, head) with two legs of thigh,
/// shank and foot. Hip and ankle are pins; the knee is a hinge whose axis moves in the thigh with
/// its angle. Constants are computed once. Quantities of a leg have two lanes, V2{first leg, second
/// leg}.
///
/// Coordinates are interleaved likewise: hip, knee, ankle of both legs at 2 · joint + leg, then
/// tilt, x, y; muscles at 2 · muscle + leg.
struct PlanarModel {
  static constexpr int kLegs = 2, kJoints = 3, kSegments = 4;  // segment 0 is the base
  static constexpr int kMusclesOfLeg = simulation::kMusclesOfLeg, kMuscles = simulation::kMuscles;
  static constexpr int kMuscleGroups = (kMuscles + 3) / 4;  // of four
  static_assert(kMusclesOfLeg == 9 && simulation::kCoordinates == kLegs * kJoints + 3,
                "the planar engine's lanes and eliminations are laid out for two legs of three "
                "joints and nine muscles; another model runs on the simbody engine alone");
  static constexpr int kFunctions = 8;  // of the knee angle: the hinge x, y; moving points x, y

  /// Pose of a body in its segment: a planar transform and a constant z.
  struct Place {
    int leg = -1, segment = 0;  // leg -1: the base
    double angle_rad = 0, x_m = 0, y_m = 0, z_m = 0;
  };
  std::vector<Place> bodies;            // in the order of Model::bodies
  std::array<int, 9> coordinate{};      // of the engine's order → interleaved
  double gravity_x = 0, gravity_y = 0;  // m/s²
  double total_mass_kg = 0;

  /// Mass, moment of inertia about the centre of mass, and centre of mass in the segment frame.
  std::array<simd::V2, kSegments> mass_kg{}, inertia_kg_m2{}, center_x_m{}, center_y_m{};
  simd::V2 hip_x_m{}, hip_y_m{}, ankle_x_m{}, ankle_y_m{};

  /// Cubics of the knee angle between merged knots; straight beyond the first and last.
  struct KneeTable {
    std::vector<double> knots;  // interval i lies between knots[i - 1] and knots[i]
    struct alignas(32) Cubics {
      std::array<simd::V4, 2> a, b, c, d;  // of h = angle - origin
      double origin = 0;
    };
    std::vector<Cubics> cubics;  // one more than knots
  };
  std::array<KneeTable, kLegs> knee;
  double knee_range_min[kLegs] = {}, knee_range_max[kLegs] = {};  // clamp moving points (O9)

  /// End points of pieces between two segments.
  struct Point {
    int segment = 0;
    simd::V2 x_m{}, y_m{}, z_m{};
    int function = -1;  // of a moving point: x is this function of the knee angle, y the next
  };
  static constexpr int kMostPoints = 64;
  std::vector<Point> points;

  /// A muscle's path with a given set of conditional points present.
  struct Piece {
    int inner = 0, outer = 0;  // points; outer is on the segment further from the base
    double dz_m = 0;
    double weight = 0;             // 0: there is no such piece
    double crosses[kJoints] = {};  // 1 for each joint between the two
    double moves = 0;              // 1 if outer is the muscle's moving point, -1 if inner is
  };
  struct Path {
    double constant_m = 0;  // pieces within a segment
    std::array<Piece, 2> pieces;
  };
  struct Condition {
    int joint = -1;
    double range_min[kLegs] = {}, range_max[kLegs] = {};
    int bit = 1;
  };
  static constexpr int kMostConditions = 2;
  struct MusclePath {
    int pieces = 1;
    int first_joint = 0, last_joint = 0;  // that the muscle crosses
    int moving = -1;                      // the point that moves, if one does
    std::vector<Condition> conditions;
    /// Indexed by the bits of the conditions that hold.
    std::array<std::array<Path, kLegs>, 1 << kMostConditions> variants;
  };
  std::array<MusclePath, kMusclesOfLeg> paths;

  /// Constants of MuscleLaw, by groups of four; the two lanes beyond the last muscle repeat it.
  struct alignas(32) Muscles {
    simd::V4 max_force, optimal_inverse, slack_inverse, max_speed, width2, minimum_length;
    simd::V4 cos_max_pennation, minimum_activation, tau_activation_inverse;
    simd::V4 tau_deactivation_inverse, active_shape_inverse, passive_rate, passive_scale;
    simd::V4 toe_strain, toe_rate, toe_scale, linear_stiffness, af_inverse, flen;
    simd::V4 straight_from;  // linear_from · flen
    simd::V4 lengthening;    // (2 + 2 / af) / (1 - flen)
  };
  std::array<Muscles, kMuscleGroups> muscles;

  /// The spheres of the feet, V4{first sphere of both legs, second of both}, on segment 3.
  simd::V4 sphere_x_m{}, sphere_y_m{}, sphere_z_m{}, sphere_radius_m{};
  int spheres_of_foot = 0;                        // 0: no foot touches the ground
  std::array<int, kLegs> contact_of_leg{-1, -1};  // index into Model::contacts
  laws::ContactLaw contact;
  double ground_height_m = 0;

  struct Limit {
    int coordinate = 0;  // interleaved: of a leg
    laws::LimitLaw law;
  };
  std::vector<Limit> limits;  // in the order of Model::limits
};

inline constexpr int kLegs = PlanarModel::kLegs;

/// Throws Error with the reason and the cure `--engine simbody` if the model has another topology.
PlanarModel planar_model(const osim::Model& model);

}  // namespace stride::planar
