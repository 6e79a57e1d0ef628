#include "calibrate/aperiodic/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stride::aperiodic {
namespace {

/// Frames on which a part that is needed lies outside the picture: it was not seen there.
void judge_picture(const Trajectory& trajectory, gait::ClipVerdict& verdict) {
  int first = -1, last = -1, count = 0;
  for (const TrajectoryFrame& frame : trajectory.frames) {
    const bool outside = std::ranges::any_of(kRequiredParts, [&](BodyPart part) {
      const Point& point = frame[part];
      if (!point.present()) return false;
      const Eigen::Vector2d& p = point.p_px;
      return p.x() < -0.5 || p.y() < -0.5 || p.x() > trajectory.width_px - 0.5 ||
             p.y() > trajectory.height_px - 0.5;
    });
    if (!outside) continue;
    if (first < 0) first = frame.frame;
    last = frame.frame;
    ++count;
  }
  if (count == 0) return;
  const std::string text = fmt::format(
      "the jumper leaves the picture: on {} frames between {} and {} a knee, an ankle or the "
      "pelvis is outside it; film from farther away, or trim the clip",
      count, first, last);
  count > 3 ? verdict.refuse(text) : verdict.note(text);
}

/// Longest stretch of frames on which a foot was not seen in the middle of the movement.
void judge_unseen(const Trajectory& trajectory, const fit::Marks& marks, const Flight& flight,
                  gait::ClipVerdict& verdict) {
  int unseen = 0, frames = 0;
  for (std::size_t i = 0; i < trajectory.frames.size(); ++i) {
    if (marks.u_s[i] < flight.take_off_s - 0.1 || marks.u_s[i] > flight.landing_s + 0.1) continue;
    ++frames;
    const auto seen = [&](BodyPart part) { return trajectory.frames[i][part].seen(); };
    unseen += !seen(BodyPart::ankle_r) && !seen(BodyPart::ankle_l);
  }
  if (frames > 0 && unseen * 3 > frames)
    verdict.refuse(fmt::format(
        "on {} of the {} frames of the flight no foot is seen: hidden or out of the picture",
        unseen, frames));
}

void judge_fall(const Scale& scale, gait::ClipVerdict& verdict) {
  constexpr double kUnlike = 3;  // standard deviations
  if (std::abs(scale.disagreement) > kUnlike) {
    const std::string text = fmt::format(
        "a runner with a leg of the usual length would fall with {:.2f} g here: is the slow-motion "
        "factor (--slow-motion {:.2f} would explain it) or the runner's size (--leg) right?",
        scale.fall_factor, 1 / std::sqrt(scale.fall_factor));
    scale.fall_factor<0.4 || scale.fall_factor> 2.5 ? verdict.refuse(text) : verdict.alarm(text);
  }
}

}  // namespace

void judge_passage(const Trajectory& trajectory, const fit::Marks& marks, const PassageFit& fit,
                   const GroundPath& path, const Flight& flight, const Scale& scale,
                   gait::ClipVerdict& verdict) {
  if (!fit.ok) {
    verdict.refuse(fit.failure);
    return;
  }
  judge_picture(trajectory, verdict);
  gait::judge_misses(fit.sigma_px / fit.passage.leg_px(), fit.backward, verdict);
  if (fit.outlier_fraction > 0.12)
    verdict.alarm(
        fmt::format("{:.0f} % of the marks fit no movement: swapped legs, another "
                    "person, or lost tracks",
                    100 * fit.outlier_fraction));
  const double ratio = fit.passage.limbs[limb::thigh] / fit.passage.limbs[limb::shank];
  if (ratio < 0.65 || ratio > 1.5)
    verdict.alarm(fmt::format(
        "the thigh is {:.2f} times the shank: a character, or marks on wrong joints", ratio));
  if (!fit.head_seen)
    verdict.note(fmt::format("{} is not marked: nothing tells how the trunk leans; mark it",
                             name(BodyPart::head)));
  if (flight.flights > 1)
    verdict.refuse(fmt::format(
        "both feet leave the ground {} times: of several jumps trim the clip to one; a run is "
        "--movement run",
        flight.flights));
  if (!flight.ok) {
    if (flight.flights < 2) verdict.refuse(flight.failure);
    return;
  }
  judge_unseen(trajectory, marks, flight, verdict);
  judge_fall(scale, verdict);
  if (path.u_s.back() - flight.landing_s < 0.15)
    verdict.note(
        fmt::format("the clip ends {:.2f} s after the landing: nothing tells whether it "
                    "was stood",
                    path.u_s.back() - flight.landing_s));
}

}  // namespace stride::aperiodic
