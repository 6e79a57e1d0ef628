#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "calibrate/fit/solver/marks.h"
#include "calibrate/fit/solver/stride_fit.h"
#include "calibrate/runner/runner.h"

namespace stride::aperiodic {

/// The angles of the runner, rad, in the order of the model's coordinates.
enum Angle { tilt, hip_r, knee_r, ankle_r, hip_l, knee_l, ankle_l, kAngles };
using Angles = std::array<double, kAngles>;

namespace limb {  // px; depth: half of by how much the right leg looks larger
enum { thigh, shank, foot, trunk, depth, size };
}

/// Where a time lies among the control points of a uniform cubic B-spline.
struct SplinePlace {
  int first = 0;                   // of the four that matter
  std::array<double, 4> weight{};  // their weights, of sum 1
};

/// A runner in a movement with a beginning and an end, as the fit sees one: limbs of constant
/// length in the image, which faces right with y up, and angles in the image's axes.
struct Passage {
  std::array<double, limb::size> limbs{};
  double first_s = 0, knot_s = 0.1;        // of the first control interval; its length
  std::vector<Angles> knots;               // control points, three more than intervals
  std::vector<Eigen::Vector2d> pelvis_px;  // of every frame, as Mark::z_px

  SplinePlace place(double u_s) const;
  Angles angles(double u_s) const;
  double leg_px() const { return limbs[limb::thigh] + limbs[limb::shank]; }
};

/// A passage without angles over these times, its control points at most `knot_s` apart.
Passage empty_passage(const std::vector<double>& u_s, double knot_s);

/// A part from the marked pelvis, px.
template <typename T>
Vector2<T> about_pelvis(BodyPart part, const Directions& directions, const T* limbs,
                        const std::array<T, kAngles>& angles) {
  const std::array<T, body::size> lengths{limbs[limb::thigh],
                                          limbs[limb::shank],
                                          limbs[limb::foot],
                                          limbs[limb::trunk],
                                          T(0),
                                          T(0),
                                          T(0)};
  std::array<T, sides::size> differences{};
  differences[sides::depth] = limbs[limb::depth];
  const int hip = side_of(part) < 0 ? hip_l : hip_r;
  return place_part<T>(part, directions, lengths.data(), differences.data(), angles[tilt],
                       {angles[hip], angles[hip + 1], angles[hip + 2]}, T(0));
}

/// A fitted passage. Failure is a value: `ok` false with `failure`.
struct PassageFit {
  bool ok = false;
  std::string failure;
  Passage passage;
  bool toes_seen = false, head_seen = false, backward = false;
  double seen_px = 0;  // robust standard deviation of a mark's residual
  double sigma_px = 0, rms_px = 0, outlier_fraction = 0;
  double correlation = 1;                // number of frames equivalent to one independent frame
  std::vector<fit::MarkResidual> marks;  // of Marks::points
  /// Of the limbs, then the control points one after another; the pelvises are eliminated.
  Eigen::MatrixXd covariance;
};

/// A part in the image of a frame, px as Mark::z_px.
Eigen::Vector2d predicted_px(const Passage& passage, const Directions& directions, BodyPart part,
                             int frame, double u_s);

}  // namespace stride::aperiodic
