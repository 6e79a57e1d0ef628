#include "calibrate/aperiodic/start.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "extract/io/statistics.h"

namespace stride::aperiodic {
namespace {

using Eigen::Vector2d;

/// Marks by part and frame; NaN where there is none.
using Grid = std::array<std::vector<Vector2d>, kBodyPartCount>;

Grid grid_of(const fit::Marks& marks) {
  Grid grid;
  for (auto& part : grid) part.assign(marks.u_s.size(), Vector2d::Constant(std::nan("")));
  for (const fit::Mark& mark : marks.points)
    grid[static_cast<std::size_t>(index(mark.part))][static_cast<std::size_t>(mark.frame)] =
        mark.z_px;
  return grid;
}

/// From one part to another on every frame.
std::vector<Vector2d> between(const Grid& grid, BodyPart from, BodyPart to) {
  std::vector<Vector2d> all;
  for (std::size_t i = 0; i < grid[0].size(); ++i)
    all.emplace_back(grid[static_cast<std::size_t>(index(to))][i] -
                     grid[static_cast<std::size_t>(index(from))][i]);
  return all;
}

double median_length(const std::vector<Vector2d>& right, const std::vector<Vector2d>& left) {
  std::vector<double> lengths;
  for (const auto* side : {&right, &left})
    for (const Vector2d& d : *side)
      if (d.allFinite()) lengths.push_back(d.norm());
  return lengths.empty() ? 0 : median(std::move(lengths));
}

/// Angles against `zero`, ccw, continuous in time; NaN where a mark is missing.
std::vector<double> angles_of(const std::vector<Vector2d>& vectors, const Vector2d& zero) {
  std::vector<double> angles;
  double last = 0;
  for (const Vector2d& v : vectors) {
    const double angle = std::atan2(zero.x() * v.y() - zero.y() * v.x(), zero.dot(v));
    const double turn = 2 * std::numbers::pi;
    angles.push_back(angle + turn * std::round((last - angle) / turn));
    if (std::isfinite(angle)) last = angles.back();
  }
  return angles;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all;
  for (std::size_t i = 0; i < a.size(); ++i) all.push_back(a[i] - b[i]);
  return all;
}

/// Sets one angle of the control points.
void through(const std::vector<double>& values, const std::vector<double>& u_s, Angle angle,
             Passage& passage) {
  constexpr double kStiff = 0.05;  // of second differences, where frames are silent
  const auto n = static_cast<Eigen::Index>(passage.knots.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(n, n) * 1e-6;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 1; k + 1 < n; ++k) {
    const Eigen::Vector3d bend(1, -2, 1);
    normal.block<3, 3>(k - 1, k - 1) += kStiff * bend * bend.transpose();
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const SplinePlace at = passage.place(u_s[i]);
    const Eigen::Vector4d w = Eigen::Map<const Eigen::Vector4d>(at.weight.data());
    normal.block<4, 4>(at.first, at.first) += w * w.transpose();
    right.segment<4>(at.first) += w * values[i];
  }
  const Eigen::VectorXd solution = normal.ldlt().solve(right);
  for (Eigen::Index k = 0; k < n; ++k)
    passage.knots[static_cast<std::size_t>(k)][angle] = solution[k];
}

}  // namespace

PassageFit start(const fit::Marks& marks, const Directions& directions, double knot_s) {
  constexpr double kUnseenTilt_rad = -0.17;
  PassageFit fit;
  fit.passage = empty_passage(marks.u_s, knot_s);
  fit.toes_seen = marks.sees_toes();
  fit.head_seen = marks.sees(BodyPart::head);
  const Grid grid = grid_of(marks);
  Passage& p = fit.passage;
  struct Leg {
    std::vector<Vector2d> thigh, shank, foot;
    Angle hip, knee, ankle;
  };
  const auto leg_of = [&](BodyPart knee, BodyPart ankle, BodyPart toe, Angle hip, Angle bend,
                          Angle foot) {
    return Leg{between(grid, BodyPart::pelvis, knee),
               between(grid, knee, ankle),
               between(grid, ankle, toe),
               hip,
               bend,
               foot};
  };
  const std::array<Leg, 2> legs{
      leg_of(BodyPart::knee_r, BodyPart::ankle_r, BodyPart::toe_r, hip_r, knee_r, ankle_r),
      leg_of(BodyPart::knee_l, BodyPart::ankle_l, BodyPart::toe_l, hip_l, knee_l, ankle_l)};
  const std::vector<Vector2d> trunk = between(grid, BodyPart::pelvis, BodyPart::head);

  p.limbs[limb::thigh] = median_length(legs[0].thigh, legs[1].thigh);
  p.limbs[limb::shank] = median_length(legs[0].shank, legs[1].shank);
  const bool whole = p.limbs[limb::thigh] > 0 && p.limbs[limb::shank] > 0;
  if (!whole) fit.failure = "too few marks of pelvis, knees and ankles on the same frames";
  if (!whole) return fit;
  p.limbs[limb::foot] =
      fit.toes_seen ? median_length(legs[0].foot, legs[1].foot) : 0.47 * p.limbs[limb::shank];
  p.limbs[limb::trunk] = fit.head_seen ? median_length(trunk, trunk) : 0.87 * p.leg_px();

  std::vector<double> tilts(marks.u_s.size(), kUnseenTilt_rad);
  if (fit.head_seen) tilts = angles_of(trunk, directions.trunk);
  through(tilts, marks.u_s, tilt, p);
  const Vector2d down(0, -1);
  for (const Leg& leg : legs) {
    const std::vector<double> thigh = angles_of(leg.thigh, down),
                              shank = angles_of(leg.shank, down);
    through(difference(thigh, tilts), marks.u_s, leg.hip, p);
    through(difference(shank, thigh), marks.u_s, leg.knee, p);
    if (fit.toes_seen)
      through(difference(angles_of(leg.foot, directions.foot), shank), marks.u_s, leg.ankle, p);
  }
  // The knees bend forward: the image is mirrored. Told before the joints' limits forbid it.
  double bend = 0;
  for (const Angles& knot : p.knots) bend += knot[knee_r] + knot[knee_l];
  fit.backward = bend > 0;

  Vector2d last = Vector2d::Zero();
  const auto& pelvis = grid[static_cast<std::size_t>(index(BodyPart::pelvis))];
  for (const Vector2d& seen : pelvis)
    if (seen.allFinite()) {
      last = seen;
      break;
    }
  for (std::size_t i = 0; i < pelvis.size(); ++i) {
    if (pelvis[i].allFinite()) last = pelvis[i];
    p.pelvis_px[i] = last;
  }
  return fit;
}

}  // namespace stride::aperiodic
