#include "calibrate/aperiodic/flight.h"

#include <fmt/format.h>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "extract/io/statistics.h"
#include "extract/skeleton/least_squares.h"
#include "extract/skeleton/units.h"

namespace stride::aperiodic {
namespace {

using Eigen::Vector2d;

constexpr double kLifted = 0.03;  // of a leg: a foot that high is off the ground
constexpr double kShortestFlight_s = 0.1;

/// What the camera's motion adds to a point of each frame, px as Mark::z_px.
std::vector<Vector2d> camera_shift(const Trajectory& trajectory, bool to_left) {
  std::vector<Vector2d> shift;
  Vector2d sum = Vector2d::Zero();
  for (const TrajectoryFrame& frame : trajectory.frames) {
    const Vector2d& step = frame.camera_px;
    if (step.allFinite() && !shift.empty())
      sum += Vector2d(to_left ? step.x() : -step.x(), step.y());
    shift.push_back(sum);
  }
  return shift;
}

Vector2d centre_of_mass(const Passage& p, const Directions& directions, int frame, double u_s) {
  const auto at = [&](BodyPart part) { return predicted_px(p, directions, part, frame, u_s); };
  const auto along = [](const Segment& s, const Vector2d& a, const Vector2d& b) -> Vector2d {
    return s.mass * (a + s.along * (b - a));
  };
  const Vector2d hips = at(BodyPart::pelvis);
  Vector2d sum = along({kUpper.mass, kUpper.along * kShoulders}, hips, at(BodyPart::head));
  for (const auto& [knee, ankle, toe] :
       {std::array{BodyPart::knee_r, BodyPart::ankle_r, BodyPart::toe_r},
        std::array{BodyPart::knee_l, BodyPart::ankle_l, BodyPart::toe_l}})
    sum += along(kThigh, hips, at(knee)) + along(kShank, at(knee), at(ankle)) +
           along(kFoot, at(ankle), at(toe));
  return sum;
}

/// A low value that a few lower ones do not move.
double low(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 5];
}

std::vector<double> heights(const std::vector<Vector2d>& points, std::size_t from, std::size_t to) {
  std::vector<double> all;
  for (std::size_t i = from; i < to; ++i) all.push_back(points[i].y());
  return all;
}

std::size_t highest(const std::vector<Vector2d>& points) {
  return static_cast<std::size_t>(
      std::ranges::max_element(points, {}, [](const Vector2d& p) { return p.y(); }) -
      points.begin());
}

/// The height of the lower foot above where it stands before and after the highest frame.
std::vector<double> clearance(const GroundPath& path, double leg_px) {
  const double slope_px = 0.06 * leg_px;
  const std::size_t n = path.pelvis_px.size();
  const std::size_t top = std::clamp<std::size_t>(highest(path.pelvis_px), 1, n - 1);
  std::vector<double> all(n, std::numeric_limits<double>::infinity());
  for (const auto& foot : path.feet_px) {
    // The ground is level within the slope that a camera's roll gives it; a foot that stays higher
    // does not stand.
    const double left = low(heights(foot, 0, top)), landed = low(heights(foot, top, n));
    const double before = std::min(left, landed + slope_px),
                 after = std::min(landed, left + slope_px);
    for (std::size_t i = 0; i < n; ++i)
      all[i] = std::min(all[i], foot[i].y() - (i < top ? before : after));
  }
  return all;
}

/// Where the clearance would be 0 on the straight line through two frames.
double crossing_s(const GroundPath& path, std::size_t a, std::size_t b) {
  const double rise = path.clearance_px[b] - path.clearance_px[a];
  const double at = path.u_s[a] - path.clearance_px[a] * (path.u_s[b] - path.u_s[a]) / rise;
  return std::clamp(at, path.u_s[a] - (path.u_s[b] - path.u_s[a]), path.u_s[b]);
}

/// Intervals of frames [first, last] with both feet in the air.
std::vector<std::pair<std::size_t, std::size_t>> airborne(const GroundPath& path,
                                                          double lifted_px) {
  std::vector<std::pair<std::size_t, std::size_t>> all;
  for (std::size_t i = 0; i < path.u_s.size(); ++i) {
    if (path.clearance_px[i] < lifted_px) continue;
    if (!all.empty() && all.back().second + 1 == i)
      all.back().second = i;
    else
      all.emplace_back(i, i);
  }
  return all;
}

/// Parabola through the centre of mass between take-off and landing.
void fall(const GroundPath& path, const PassageFit& fit, Flight& flight) {
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < path.u_s.size(); ++i)
    if (path.u_s[i] > flight.take_off_s + 0.01 && path.u_s[i] < flight.landing_s - 0.01)
      frames.push_back(i);
  const auto n = static_cast<Eigen::Index>(frames.size());
  if (n < 5) {
    flight.failure = fmt::format("{} frames show the flight: five are needed", n);
    return;
  }
  Eigen::MatrixXd rows(n, 3), values(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = path.u_s[frames[static_cast<std::size_t>(i)]] - flight.take_off_s;
    rows.row(i) << 1, t, 0.5 * t * t;
    values.row(i) = path.com_px[frames[static_cast<std::size_t>(i)]].transpose();
  }
  const Eigen::MatrixXd found = least_squares(rows, values);
  flight.velocity_px_s = found.row(1);
  if (!(found(2, 1) < 0)) {
    flight.failure = "the centre of mass does not fall while both feet are off the ground";
    return;
  }
  flight.px_per_m = -found(2, 1) / kGravity_m_s2;
  // Of a mark, the centre of mass has 0.46 of the pelvis' noise, 0.33 of the head's and little of
  // the legs'; neighbouring frames repeat one another.
  constexpr double kShare = 0.58;
  const double noise_px = kShare * fit.sigma_px * std::sqrt(fit.correlation);
  const Eigen::Matrix3d normal = rows.transpose() * rows;
  const double variance = normal.inverse()(2, 2);
  flight.relative_sd = noise_px * std::sqrt(variance) / -found(2, 1);
  flight.ok = true;
}

/// By how much faster than the background the ground passes below the runner: such that the feet
/// that stand stay where they are. `shift`: of every frame, px.
double parallax_of(const GroundPath& path, const std::vector<Vector2d>& shift, double leg_px) {
  constexpr double kNear = 1, kFar = 2.5, kSpread = 0.005;  // of a leg a frame: a foot that rolls
  double factor = 1;
  for (int round = 0; round < 10; ++round) {
    double with = 0, squares = 0;
    for (std::size_t i = 1; i < path.u_s.size(); ++i) {
      if (path.clearance_px[i] > kLifted * leg_px || path.clearance_px[i - 1] > kLifted * leg_px)
        continue;
      const double moved = shift[i].x() - shift[i - 1].x();
      for (const auto& foot : path.feet_px) {
        const double seen = foot[i].x() - foot[i - 1].x() - moved;  // in the image as it is
        const double left = (seen + factor * moved) / (kSpread * leg_px);
        const double weight = 1 / (1 + left * left);
        with -= weight * seen * moved;
        squares += weight * moved * moved;
      }
    }
    if (squares < std::pow(0.02 * leg_px, 2)) return 1;  // the camera stands
    factor = std::clamp(with / squares, kNear, kFar);
  }
  return factor;
}

std::array<std::vector<Vector2d>*, 6> lines_of(GroundPath& path) {
  return {&path.pelvis_px,  &path.com_px,     &path.feet_px[0],
          &path.feet_px[1], &path.feet_px[2], &path.feet_px[3]};
}

}  // namespace

GroundPath ground_path(const Trajectory& trajectory, const fit::Marks& marks, const PassageFit& fit,
                       const Directions& directions, const fit::Prior& roll) {
  const std::vector<Vector2d> shift = camera_shift(trajectory, marks.to_left);
  GroundPath path;
  path.u_s = marks.u_s;
  path.roll_rad = roll.mean;
  path.roll_sd_rad = roll.sd;
  constexpr std::array kFeet{BodyPart::ankle_r, BodyPart::toe_r, BodyPart::ankle_l,
                             BodyPart::toe_l};
  for (std::size_t i = 0; i < path.u_s.size(); ++i) {
    const int frame = static_cast<int>(i);
    const double u = path.u_s[i];
    path.pelvis_px.emplace_back(fit.passage.pelvis_px[i] + shift[i]);
    path.com_px.emplace_back(centre_of_mass(fit.passage, directions, frame, u) + shift[i]);
    for (std::size_t k = 0; k < kFeet.size(); ++k)
      path.feet_px[k].push_back(predicted_px(fit.passage, directions, kFeet[k], frame, u) +
                                shift[i]);
  }
  path.clearance_px = clearance(path, fit.passage.leg_px());
  path.parallax = parallax_of(path, shift, fit.passage.leg_px());
  for (auto* line : lines_of(path))
    for (std::size_t i = 0; i < line->size(); ++i)
      (*line)[i].x() += (path.parallax - 1) * shift[i].x();
  // The feet stand on the same ground before and after: its slope, to a centimetre of a leg.
  const std::size_t n = path.u_s.size(), quarter = std::max<std::size_t>(n / 8, 1);
  Vector2d first = Vector2d::Zero(), last = Vector2d::Zero();
  for (const auto& foot : path.feet_px)
    for (std::size_t i = 0; i < quarter; ++i) {
      first += foot[i] / (4.0 * static_cast<double>(quarter));
      last += foot[n - 1 - i] / (4.0 * static_cast<double>(quarter));
    }
  const Vector2d displacement = last - first;
  constexpr double kSteepest = 0.1;  // rad: else it does not stand before or after
  if (displacement.x() > 0.4 * fit.passage.leg_px() &&
      std::abs(displacement.y()) < kSteepest * displacement.x()) {
    const double sd = 0.012 * fit.passage.leg_px() / displacement.x(),
                 seen = std::atan2(displacement.y(), displacement.x());
    const double a = 1 / (sd * sd), b = 1 / (roll.sd * roll.sd);
    path.roll_rad = (a * seen + b * roll.mean) / (a + b);
    path.roll_sd_rad = 1 / std::sqrt(a + b);
  }
  for (auto* line : lines_of(path))
    for (Vector2d& p : *line) p = turned(-path.roll_rad, p);
  path.clearance_px = clearance(path, fit.passage.leg_px());
  return path;
}

Flight find_flight(const GroundPath& path, const PassageFit& fit) {
  Flight flight;
  const double lifted_px = kLifted * fit.passage.leg_px();
  const auto intervals = airborne(path, lifted_px);
  std::pair<std::size_t, std::size_t> longest{0, 0};
  for (const auto& each : intervals) {
    const double lasts_s = path.u_s[each.second] - path.u_s[each.first];
    if (lasts_s > 0.04) ++flight.flights;
    if (lasts_s > path.u_s[longest.second] - path.u_s[longest.first]) longest = each;
  }
  const auto [first, last] = longest;
  const double lasts_s = path.u_s[last] - path.u_s[first];
  if (lasts_s < kShortestFlight_s) {
    flight.failure = "both feet never leave the ground together for a tenth of a second: no jump";
    return flight;
  }
  if (first == 0) {
    flight.failure =
        "the clip begins in the air: half a jump; it needs the standing before the take-off";
    return flight;
  }
  if (last + 1 >= path.u_s.size()) {
    flight.failure =
        "the clip ends in the air: half a jump; it needs the landing and the standing after it";
    return flight;
  }
  flight.take_off_s = crossing_s(path, first, first + 1);
  flight.landing_s = crossing_s(path, last, last - 1);
  if (flight.landing_s < path.u_s[last]) flight.landing_s = path.u_s[last];
  flight.landing_s = std::min(flight.landing_s, path.u_s[last + 1]);
  flight.take_off_s = std::clamp(flight.take_off_s, path.u_s[first - 1], path.u_s[first]);
  fall(path, fit, flight);
  return flight;
}

}  // namespace stride::aperiodic
