#include "calibrate/gait/verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/fit/ground_slope.h"
#include "extract/io/statistics.h"
#include "extract/skeleton/movement.h"
#include "extract/skeleton/units.h"
#include "extract/tracking/time_check.h"

namespace stride::gait {
namespace {

/// The distance that holds 90 % of the values.
double spread(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[values.size() * 95 / 100] - values[values.size() * 5 / 100];
}

/// A coordinate of one part relative to another, where both are labelled.
std::vector<double> differences(const Trajectory& trajectory, BodyPart part, BodyPart from,
                                int axis) {
  std::vector<double> values;
  for (const TrajectoryFrame& frame : trajectory.frames)
    if (frame[part].present() && frame[from].present())
      values.push_back(frame[part].p_px[axis] - frame[from].p_px[axis]);
  return values;
}

double median_length(const Trajectory& trajectory, BodyPart a, BodyPart b) {
  std::vector<double> values;
  for (const TrajectoryFrame& frame : trajectory.frames)
    if (frame[a].present() && frame[b].present())
      values.push_back((frame[a].p_px - frame[b].p_px).norm());
  return median(values);
}

void judge_parts(const Trajectory& trajectory, ClipVerdict& verdict) {
  constexpr std::size_t kLeastFrames = 8;
  const std::size_t frames = trajectory.frames.size();
  if (frames < kLeastFrames) {
    verdict.refuse(fmt::format("{} frames: at least {} are needed", frames, kLeastFrames));
    return;
  }
  for (const BodyPart part : kRequiredParts) {
    const auto seen = std::ranges::count_if(
        trajectory.frames, [&](const TrajectoryFrame& frame) { return frame[part].present(); });
    const auto count = static_cast<std::size_t>(seen);
    if (count < kLeastFrames || count * 4 < frames)
      verdict.refuse(fmt::format("{} is marked in {} of {} frames: a quarter is needed; mark it",
                                 name(part), count, frames));
    else if (std::ranges::none_of(trajectory.frames,
                                  [&](const TrajectoryFrame& frame) { return frame[part].seen(); }))
      verdict.refuse(fmt::format(
          "{} is seen in no frame: what the other leg does tells nothing of it; mark it",
          name(part)));
  }
}

/// From the pelvis to both ankles, on average.
Eigen::Vector2d mean_leg_px(const Trajectory& trajectory) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double n = 0;
  for (const TrajectoryFrame& frame : trajectory.frames)
    for (const BodyPart ankle : {BodyPart::ankle_r, BodyPart::ankle_l})
      if (frame[ankle].present() && frame[BodyPart::pelvis].present()) {
        sum += frame[ankle].p_px - frame[BodyPart::pelvis].p_px;
        ++n;
      }
  return sum / std::max(n, 1.0);
}

/// Legs hang down from a pelvis that is between the hips.
void judge_posture(const Trajectory& trajectory, double leg_px, ClipVerdict& verdict) {
  const Eigen::Vector2d leg = mean_leg_px(trajectory);
  if (leg.y() < 0 && -leg.y() > std::abs(leg.x()))
    verdict.refuse(
        "knees are above the pelvis: the clip stands on its head; turn it (points whose y grows "
        "upwards: stride track --import … --y-up)");
  else if (std::abs(leg.x()) > std::abs(leg.y()))
    verdict.refuse(
        "the legs lie level: the clip, or the picture that its points were made on, is turned by "
        "90 degrees; turn it (or is it an animal, or nobody upright?)");
  std::vector<double> off;
  for (const TrajectoryFrame& frame : trajectory.frames) {
    const Point &right = frame[BodyPart::hip_r], &left = frame[BodyPart::hip_l];
    if (right.present() && left.present() && frame[BodyPart::pelvis].present())
      off.push_back((frame[BodyPart::pelvis].p_px - 0.5 * (right.p_px + left.p_px)).norm() /
                    leg_px);
  }
  if (off.size() >= 3 && median(off) > 0.35)
    verdict.refuse(fmt::format(
        "the pelvis is {:.0f} % of a leg from the middle of the hips: are the points on the right "
        "joints, or of another layout (OpenPose's BODY_25B)?",
        100 * median(off)));
}

bool is_normalised(const Trajectory& trajectory) {
  return std::ranges::all_of(trajectory.frames, [](const TrajectoryFrame& frame) {
    return std::ranges::all_of(frame.points, [](const Point& point) {
      return !point.present() || point.p_px.lpNorm<Eigen::Infinity>() <= 2;
    });
  });
}

/// Amplitude of the ankles in leg lengths; a runner's is about two thirds fore and aft.
void judge_view(const Trajectory& trajectory, ClipVerdict& verdict) {
  double leg = 0, fore_aft = 0, vertical = 0;
  for (const auto& [knee, ankle] : {std::pair{BodyPart::knee_r, BodyPart::ankle_r},
                                    std::pair{BodyPart::knee_l, BodyPart::ankle_l}}) {
    leg += 0.5 * (median_length(trajectory, BodyPart::pelvis, knee) +
                  median_length(trajectory, knee, ankle));
    fore_aft += 0.5 * spread(differences(trajectory, ankle, BodyPart::pelvis, 0));
    vertical += 0.5 * spread(differences(trajectory, ankle, BodyPart::pelvis, 1));
  }
  if (is_normalised(trajectory)) {
    verdict.refuse("all points lie between 0 and 2: normalised coordinates, not pixels");
    return;
  }
  if (!(leg > 10)) {
    verdict.refuse(fmt::format("legs are {:.0f} px long: ten are needed; use a larger video", leg));
    return;
  }
  judge_posture(trajectory, leg, verdict);
  if (!movement(trajectory.movement).repeats) return;
  if (fore_aft < 0.3 * leg && vertical < 0.12 * leg)
    verdict.refuse(fmt::format(
        "the feet move by {:.0f} % of a leg: nobody runs here; is another person in the "
        "file of points the runner (stride track --import … --person 2), or are they on the right "
        "joints (another layout, as OpenPose's BODY_25B)?",
        100 * std::hypot(fore_aft, vertical) / leg));
  else if (fore_aft < 0.45 * leg)
    verdict.refuse(
        fmt::format("the feet swing by {:.0f} % of a leg fore and aft, a runner's by 100 "
                    "%: not seen from the side",
                    100 * fore_aft / leg));
}

/// Whether the background's step differs from both neighbouring ones by two fifths of a leg, or is
/// lost.
bool scene_changes(const Trajectory& trajectory, std::size_t i, double leg_px) {
  const auto& frames = trajectory.frames;
  if (!frames[i].camera_px.allFinite()) return true;
  const auto leaps = [&](std::size_t j) {
    return (frames[i].camera_px - frames[j].camera_px).norm() > 0.4 * leg_px;
  };
  return i >= 2 && i + 1 < frames.size() && leaps(i - 1) && leaps(i + 1);
}

/// Frames whose background is unrelated to the previous frame's. Many of them mean that the
/// background cannot be followed, and say nothing.
void judge_scene(const Trajectory& trajectory, double leg_px, ClipVerdict& verdict) {
  std::vector<int> changes;
  for (std::size_t i = 1; i < trajectory.frames.size(); ++i)
    if (scene_changes(trajectory, i, leg_px)) changes.push_back(trajectory.frames[i].frame);
  if (changes.empty() || changes.size() > std::max<std::size_t>(1, trajectory.frames.size() / 50))
    return;
  verdict.note(fmt::format("the background changes at frame {}: a cut; trim the clip",
                           fmt::join(changes, ", ")));
}

/// A camera that tilts or zooms does not tell how the ground lies.
void judge_camera(const Trajectory& trajectory, ClipVerdict& verdict) {
  if (std::isfinite(trajectory.floor_roll_rad) || !fit::camera_turns(trajectory)) return;
  verdict.note(
      fmt::format("the camera tilts or zooms, so the ground's slope is known from the standing "
                  "feet alone: mark "
                  "the floor of {} (o in stride annotate)",
                  trajectory.video));
}

/// Jumps of the pelvis by more than half a leg between neighbouring frames.
void judge_cuts(const Trajectory& trajectory, const fit::Marks& observations,
                const fit::StrideFit& fit, double leg_px, ClipVerdict& verdict) {
  for (std::size_t i = 1; i < fit.pelvis_px.size(); ++i) {
    const double jump = (fit.pelvis_px[i] - fit.pelvis_px[i - 1]).norm();
    const double gap_s = observations.u_s[i] - observations.u_s[i - 1];
    if (jump < 0.5 * leg_px || jump / gap_s < 15 * leg_px) continue;
    verdict.note(
        fmt::format("the runner jumps by {:.0f} px at frame {}: a cut, or another person; "
                    "trim the clip",
                    jump, trajectory.frames[i].frame));
    return;
  }
}

/// The longest time in which nothing is seen: no point at all, or only points from the prior.
void judge_gaps(const Trajectory& trajectory, double period_s, ClipVerdict& verdict) {
  constexpr double kLongest = 1.0 / 3;  // of a stride
  const TrajectoryFrame* last = nullptr;
  std::array<const TrajectoryFrame*, 2> gap{};
  double longest_s = 0;
  for (const TrajectoryFrame& frame : trajectory.frames) {
    if (std::ranges::none_of(frame.points, [](const Point& point) { return point.seen(); }))
      continue;
    if (last != nullptr && frame.time_s - last->time_s > longest_s)
      longest_s = frame.time_s - last->time_s, gap = {last, &frame};
    last = &frame;
  }
  if (longest_s > kLongest * period_s)
    verdict.note(
        fmt::format("nothing is seen between frames {} and {}: black, hidden or lost; the other "
                    "strides speak for them",
                    gap[0]->frame, gap[1]->frame));
}

/// The part with the most outliers.
std::string worst_part(const fit::Marks& observations, const fit::StrideFit& fit) {
  std::array<int, kBodyPartCount> bad{};
  for (std::size_t i = 0; i < fit.marks.size(); ++i)
    bad[index(observations.points[i].part)] += fit.marks[i].outlier ? 1 : 0;
  const auto worst = std::ranges::max_element(bad) - bad.begin();
  return fmt::format("{} in {} frames", name(kBodyParts[worst]), bad[worst]);
}

/// The pelvis' greatest downward acceleration in g: free fall measures time.
double apparent_gravity(const fit::StrideFit& fit) {
  const double turn = 4 * std::numbers::pi / fit.runner.cadence[cadence::period_s];
  double least = 0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector4d w = fit::VerticalOscillation::weights(i / 100.0);
    least = std::min(least, -turn * turn *
                                (w.head<2>().dot(fit.vertical_oscillation.c.head<2>()) +
                                 4 * w.tail<2>().dot(fit.vertical_oscillation.c.tail<2>())));
  }
  return -least / kGravity_m_s2;
}

/// What no runner does.
void judge_heights(const fit::StrideFit& fit, const Gait& gait, ClipVerdict& verdict) {
  constexpr double kMost_m = 0.35;  // in a step; runners' pelvis rises by 0.06 to 0.13
  if (gait.vertical_oscillation_m > kMost_m)
    verdict.refuse(
        fmt::format("the pelvis rises and falls by {:.2f} m in a step, a runner's by a tenth: are "
                    "the marks on the right joints, does the camera shake?",
                    gait.vertical_oscillation_m));
  if (gait.speed_m_s < 0.2)
    verdict.alarm(
        fmt::format("the foot that stands goes back by {:.2f} m/s: a run on the spot, or "
                    "marks on wrong joints?",
                    gait.speed_m_s));
  const double ratio = fit.runner.body[body::thigh] / fit.runner.body[body::shank];
  if (ratio < 0.65 || ratio > 1.5)
    verdict.alarm(fmt::format(
        "the thigh is {:.2f} times the shank: a character, or marks on wrong joints", ratio));
}

/// One alarm may be a runner of an odd kind; several together are no runner.
void judge_alarms(ClipVerdict& verdict) {
  constexpr int kMost = 3;
  if (verdict.refused || verdict.alarms <= kMost) return;
  const std::string reasons = fmt::format("{}", fmt::join(verdict.reasons, "; "));
  verdict.refuse(fmt::format("{} things are unlike a runner: {}", verdict.alarms, reasons));
}

/// Whether the clip's time is the runner's. Returns whether it plays slowly, which then explains
/// all that is odd about falling and speed.
bool judge_time(const Trajectory& trajectory, const fit::StrideFit& fit, const Gait& gait,
                double strides, ClipVerdict& verdict) {
  const double period = fit.runner.cadence[cadence::period_s];
  if (strides < 0.9)
    verdict.refuse(fmt::format(
        "{:.2f} strides are seen: one is needed, two to be sure; if the clip is a loop, "
        "stride convert --loop 4",
        strides));
  else if (strides < 1.5)
    verdict.note(
        fmt::format("only {:.2f} strides are seen: nothing tells whether they repeat", strides));
  if (gait.walks && movement(trajectory.movement).gait == "run")
    verdict.note(
        fmt::format("this is walking: a foot stands for {:.0f} % of the stride", 100 * gait.duty));
  if (!gait.walks && movement(trajectory.movement).gait == "walk")
    verdict.alarm(fmt::format("this is running, not a {}: a foot stands for {:.0f} % of the stride",
                              trajectory.movement, 100 * gait.duty));
  constexpr double kImpossible_s = 0.36;  // 5.6 steps a second
  const double shortest = gait.walks ? 0.75 : 0.45, longest = gait.walks ? 1.8 : 1.05;
  if (const std::string doubt = tracking::doubt_of_period(period, shortest, longest);
      !doubt.empty())
    period < kImpossible_s ? verdict.refuse(doubt) : verdict.alarm(doubt);
  return period > longest;
}

void judge_speed(const fit::StrideFit& fit, const Gait& gait, ClipVerdict& verdict) {
  constexpr double kSprint_m_s = 8, kRecord_m_s = 12.5;  // Bolt's fastest 20 m: 12.4
  constexpr const char* kCure =
      "is the frame rate, the slow-motion factor (--slow-motion) or the runner's size (--leg) "
      "right?";
  if (gait.speed_m_s > kRecord_m_s)
    verdict.refuse(fmt::format("{:.1f} m/s is faster than anybody: {}", gait.speed_m_s, kCure));
  else if (gait.speed_m_s > kSprint_m_s)
    verdict.alarm(fmt::format("{:.1f} m/s is a sprint: {}", gait.speed_m_s, kCure));
  const double gravity = apparent_gravity(fit);
  if (!gait.walks && fit.vertical_oscillation.peak_to_peak_m() > 0.02 &&
      (gravity < 0.45 || gravity > 3))
    verdict.alarm(fmt::format("the runner falls with {:.1f} g: {}", gravity, kCure));
}

}  // namespace

void ClipVerdict::refuse(std::string reason) {
  if (!refused) reasons.clear();
  refused = true;
  reasons.push_back(std::move(reason));
}

std::string ClipVerdict::text() const {
  if (reasons.empty()) return "ok";
  return fmt::format("{}{}", refused ? "refused: " : "ok, but ", fmt::join(reasons, "; "));
}

ClipVerdict judge_marks(const Trajectory& trajectory) {
  ClipVerdict verdict;
  judge_parts(trajectory, verdict);
  if (!verdict.refused) judge_view(trajectory, verdict);
  return verdict;
}

void judge_misses(double relative, bool backward, ClipVerdict& verdict) {
  if (relative > 0.1)
    verdict.refuse(
        fmt::format("the marks miss the fitted runner by {:.0f} % of a leg: are they on "
                    "the right joints?",
                    100 * relative));
  else if (relative > 0.05)
    verdict.alarm(
        fmt::format("the marks miss the fitted runner by {:.0f} % of a leg", 100 * relative));
  if (backward)
    verdict.refuse("the knees bend forward: the runner faces the other way; set the direction");
}

void judge_line(const CalibrationLine& line, double leg_px, const fit::Prior& leg_m,
                std::string_view whose, ClipVerdict& verdict) {
  constexpr double kLeast_m = 0.2, kMost_m = 1.5,
                   kUnlike = 3;  // of any runner; standard deviations
  const double by_line_m = leg_px * line.metres_per_pixel();
  const std::string text = fmt::format(
      "by the calibration line ({}) the leg is {:.2f} m, the {} one {:.2f} m: does the line lie "
      "where "
      "the runner runs, is its length right?",
      stride::text_of(line), by_line_m, whose, leg_m.mean);
  if (by_line_m < kLeast_m || by_line_m > kMost_m)
    verdict.refuse(text);
  else if (std::abs(std::log(by_line_m / leg_m.mean)) >
           kUnlike * std::hypot(line.relative_sd(), leg_m.sd))
    verdict.note(text);
}

void judge_fit(const Trajectory& trajectory, const fit::Marks& observations,
               const fit::StrideFit& fit, const Gait& gait, ClipVerdict& verdict) {
  if (!fit.ok) {
    verdict.refuse(fit.failure);
    return;
  }
  const Runner& r = fit.runner;
  const double leg_px = stride::leg_px(r);
  const double relative = fit.sigma_px / leg_px;
  if (fit.explained < 0.75)
    verdict.refuse(
        fmt::format("no stride repeats: the best period explains {:.0f} % of how the legs "
                    "move; is it one runner, with the legs told apart? A jump is --movement jump",
                    100 * std::max(fit.explained, 0.0)));
  judge_misses(relative, fit.backward, verdict);
  const std::string outliers = fmt::format(
      "{:.0f} % of the marks fit no stride, most of them {}: swapped legs, another "
      "person, or lost tracks",
      100 * fit.outlier_fraction, worst_part(observations, fit));
  if (fit.outlier_fraction > 0.3)
    verdict.refuse(outliers);
  else if (fit.outlier_fraction > 0.12)
    verdict.alarm(outliers);
  if (!judge_time(trajectory, fit, gait, observations.duration_s / r.cadence[cadence::period_s],
                  verdict))
    judge_speed(fit, gait, verdict);
  judge_scene(trajectory, leg_px, verdict);
  judge_camera(trajectory, verdict);
  judge_cuts(trajectory, observations, fit, leg_px, verdict);
  judge_gaps(trajectory, r.cadence[cadence::period_s], verdict);
  if (gait.correlation < 0.6)
    verdict.alarm(
        fmt::format("hip and knee move unlike a human runner's (correlation {:.2f}): are the marks "
                    "on the right joints, is the frame rate or the slow-motion factor right?",
                    gait.correlation));
  judge_heights(fit, gait, verdict);
  judge_alarms(verdict);
}

}  // namespace stride::gait
