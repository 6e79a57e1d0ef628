#include "extract/tracking/track.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "extract/io/error.h"
#include "extract/io/statistics.h"
#include "extract/skeleton/movement.h"
#include "extract/tracking/measurements.h"
#include "extract/tracking/optical_flow.h"

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr double kKeptNoise_px = 0.02;
constexpr int kReweightings = 3;
constexpr int kLooks = 5;          // passes of optical flow, until the period has settled
constexpr double kSettled = 2e-3;  // change of the period

FlowOptions flow_options(double size_px) {
  FlowOptions options;
  const double scale = std::clamp(size_px / 90, 0.7, 2.0);  // tuned at 60–120 px
  options.window_px = 2 * static_cast<int>(std::lround(10 * scale)) + 1;
  options.pyramid_levels = scale > 1.5 ? 4 : 3;
  options.round_trip_px = scale;
  options.step_px = 8 * scale;
  return options;
}

/// Treadmill: the runner stays in place, within half a leg a stride, before a background at rest.
std::optional<bool> is_treadmill(const Trajectory& t, double size_px, double period_s) {
  Vector2d displacement = Vector2d::Zero();  // of the pelvis before the background
  double rest_px = 0;
  int known = 0;
  for (std::size_t i = 1; i < t.frames.size(); ++i) {
    const TrajectoryFrame &a = t.frames[i - 1], &b = t.frames[i];
    if (!b.camera_px.allFinite()) continue;
    displacement += b[BodyPart::pelvis].p_px - a[BodyPart::pelvis].p_px - b.camera_px;
    rest_px += b.camera_px.norm();
    ++known;
  }
  if (known < static_cast<int>(t.frames.size()) / 2) return std::nullopt;
  const double strides = known / t.rate_hz / period_s;
  return std::abs(displacement.x()) < 0.5 * size_px * strides && rest_px < 0.5 * size_px * strides;
}

/// On which frames, counted from the first mark, the part was said to be absent on the marked
/// frames around.
std::vector<bool> absent_frames(const Trajectory& marks, BodyPart part) {
  const int first = marks.frames.front().frame, last = marks.frames.back().frame;
  std::vector<bool> absent(static_cast<std::size_t>(last - first + 1));
  const auto fill = [&](int from, int to, bool value) {  // both included
    for (int i = from; i <= to; ++i) absent[static_cast<std::size_t>(i - first)] = value;
  };
  const TrajectoryFrame* before = nullptr;
  for (const TrajectoryFrame& mark : marks.frames) {
    const Point& point = mark[part];
    if (point.source == Source::unknown) continue;
    const bool was_absent = before == nullptr || !(*before)[part].present();
    fill(before == nullptr ? first : before->frame + 1, mark.frame - 1,
         was_absent && !point.present());
    fill(mark.frame, mark.frame, !point.present());
    before = &mark;
  }
  if (before != nullptr) fill(before->frame + 1, last, !(*before)[part].present());
  return absent;
}

/// Probability that an estimate is within 3 % of the runner's size of the joint: of a normal error
/// in the plane, with the variance that the regression says.
double share_near(const Vector2d& variance_px2, double size_px) {
  constexpr double kNear = 0.03;
  return 1 - std::exp(-std::pow(kNear * size_px, 2) / (2 * variance_px2.mean()));
}

double median_rate_hz(const std::vector<double>& times_s) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times_s.size(); ++i) steps.push_back(times_s[i] - times_s[i - 1]);
  return steps.empty() ? 30 : 1 / median(std::move(steps));
}

/// Sets the estimates and their confidence.
std::vector<TrajectoryFrame> assembled(const Trajectory& marks,
                                       const gaussian_process::Estimates& estimates,
                                       const std::vector<Measurement>& measurements,
                                       const std::vector<double>& times_s, double size_px) {
  const int first = marks.frames.front().frame;
  std::vector<TrajectoryFrame> frames(estimates.size());
  std::array<std::vector<bool>, kBodyPartCount> absent;
  for (const BodyPart part : kBodyParts) absent[index(part)] = absent_frames(marks, part);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].frame = first + static_cast<int>(i);
    frames[i].time_s = times_s[static_cast<std::size_t>(frames[i].frame)];
    for (const BodyPart part : kBodyParts) {
      const gaussian_process::Estimate& estimate = estimates[i][index(part)];
      if (!estimate.p_px.allFinite() || absent[index(part)][i]) continue;
      const double relative = 30 * std::sqrt(estimate.variance_px2.mean()) / size_px;
      frames[i][part] = {estimate.p_px, Source::predicted,
                         kPredictedConfidence / (1 + relative * relative)};
    }
  }
  for (const Measurement& r : measurements) {
    if (!r.inlier) continue;
    const double led_back = std::exp(-0.5 * r.round_trip_px * r.round_trip_px);
    for (const int frame : {r.since_frame, r.frame}) {
      const auto i = static_cast<std::size_t>(frame - first);
      Point& point = frames[i][r.part];
      if (!point.present()) continue;
      const double sure = std::min(1.0, r.weight) * led_back *
                          share_near(estimates[i][index(r.part)].variance_px2, size_px);
      const double confidence = kPredictedConfidence + (1 - kPredictedConfidence) * sure;
      point.source = Source::tracked;
      point.confidence = std::max(point.confidence, confidence);
    }
  }
  for (const TrajectoryFrame& mark : marks.frames)
    for (const BodyPart part : kBodyParts)
      if (mark[part].present()) {
        Point& point = frames[static_cast<std::size_t>(mark.frame - first)][part];
        point.source = mark[part].source;
        point.confidence = mark[part].confidence;
      }
  return frames;
}

std::vector<Measurement> joined(std::vector<Measurement> measurements,
                                const std::vector<Measurement>& others) {
  measurements.insert(measurements.end(), others.begin(), others.end());
  return measurements;
}

void check(const Trajectory& marks, const std::vector<double>& times_s) {
  require(!marks.frames.empty(), "{}: no points are marked; click some with stride annotate",
          marks.video);
  bool pelvis = false;
  for (const TrajectoryFrame& frame : marks.frames) {
    require(frame.frame < static_cast<int>(times_s.size()),
            "{}: frame {} is marked, but only {} frames could be decoded; is the video truncated?",
            marks.video, frame.frame, times_s.size());
    pelvis = pelvis || frame[BodyPart::pelvis].present();
  }
  require(pelvis, "{}: the pelvis is marked on no frame; it is needed, click it", marks.video);
}

/// What one prior makes of the picture.
struct Followed {
  gaussian_process::GaitPrior prior;                 // its period settled
  std::vector<Measurement> measurements, predicted;  // marks and flow; a prediction by others
  std::vector<FlowStretch> stretches;

  /// Share of the unmarked points where the flow is an inlier.
  double inlier() const {
    std::size_t steps = 0, inliers = 0;
    for (const FlowStretch& s : stretches) steps += static_cast<std::size_t>(s.last - s.first);
    for (const Measurement& r : measurements) inliers += r.inlier;
    return steps > 0 ? static_cast<double>(inliers) / static_cast<double>(steps) : 0;
  }
};

Followed followed(gaussian_process::GaitPrior prior, const Trajectory& marks,
                  const video::DecodedClip& clip, const TrackOptions& options) {
  const std::vector<double>& times_s = clip.times_s;
  const int first = marks.frames.front().frame, last = marks.frames.back().frame;
  const std::vector<double> span_s(times_s.begin() + first, times_s.begin() + last + 1);
  const std::vector<Measurement> unweighed = measurements_of(marks);
  gaussian_process::GaitPrior weights = prior;
  if (options.keep_marks) weights.legs.noise_px = weights.trunk.noise_px = kKeptNoise_px;
  Followed result;
  for (int look = 0; look < kLooks; ++look) {
    result.measurements = unweighed;
    weigh_marks(result.measurements, marks, weights);
    result.predicted.clear();
    if (options.prior) add_prediction(result.predicted, *options.prior, marks, weights);
    if (!options.flow || clip.crops.empty()) break;
    const gaussian_process::Estimates expected = gaussian_process::estimate(
        prior, observations_of(joined(result.measurements, result.predicted), times_s), span_s,
        false);
    result.stretches = follow(
        marks, clip.crops,
        [&](BodyPart part, int frame) {
          return expected[static_cast<std::size_t>(frame - first)][index(part)].p_px;
        },
        flow_options(video::body_size_px(marks)));
    add_flow(result.measurements, result.stretches, weights);
    // The prediction has its own period, which is no new information.
    const double before_s = prior.legs.period_s;
    prior = gaussian_process::with_period_of(prior, observations_of(result.measurements, times_s));
    if (std::abs(prior.legs.period_s / before_s - 1) < kSettled) break;
  }
  result.prior = prior;
  return result;
}

/// Where the clicks leave two periods, the one under which the flow has more inliers.
Followed best_followed(const Trajectory& marks, const video::DecodedClip& clip,
                       const TrackOptions& options) {
  constexpr double kSurely = 0.6;  // share of inliers from which other periods need not be tried
  constexpr double kClearly = 0.1;
  const auto first = clip.times_s.begin() + marks.frames.front().frame,
             last = clip.times_s.begin() + marks.frames.back().frame;
  const gaussian_process::Observations clicks =
      observations_of(measurements_of(marks), clip.times_s);
  if (!movement(marks.movement).repeats)
    return followed(gaussian_process::fit_passage_prior(clicks), marks, clip, options);
  const std::vector<gaussian_process::GaitPrior> likely =
      gaussian_process::likely_gait_priors(clicks, period_bounds({first, last + 1}));
  Followed best = followed(likely.front(), marks, clip, options);
  if (likely.size() > 1 && !best.stretches.empty() && best.inlier() < kSurely) {
    Followed other = followed(likely.back(), marks, clip, options);
    if (other.inlier() > best.inlier() + kClearly) return other;
  }
  return best;
}

}  // namespace

Tracked track(const Trajectory& marks, const video::DecodedClip& clip,
              const TrackOptions& options) {
  const std::vector<double>& times_s = clip.times_s;
  check(marks, times_s);
  const int first = marks.frames.front().frame, last = marks.frames.back().frame;
  const std::vector<double> span_s(times_s.begin() + first, times_s.begin() + last + 1);
  const Followed look = best_followed(marks, clip, options);
  Tracked tracked;
  TrackSummary& summary = tracked.summary;
  summary.prior = look.prior;
  std::vector<Measurement> measurements = joined(look.measurements, look.predicted);
  gaussian_process::Estimates estimates;
  for (int round = 0; round < kReweightings; ++round) {
    estimates = gaussian_process::estimate(summary.prior, observations_of(measurements, times_s),
                                           span_s, round + 1 == kReweightings);
    reweigh(measurements, estimates, first);
  }

  summary.labelled_frames = static_cast<int>(marks.frames.size());
  summary.shortfall = clip.shortfall;
  for (const BodyPart part : kBodyParts)
    summary.miss_px[index(part)] = std::sqrt(2 * mean_squared_miss(look.stretches, part));
  summary.inlier = look.inlier();
  tracked.trajectory = marks;
  tracked.trajectory.rate_hz = median_rate_hz(times_s);
  tracked.trajectory.frames =
      assembled(marks, estimates, measurements, times_s, video::body_size_px(marks));
  for (std::size_t i = 0; i < clip.camera.size(); ++i)
    if (clip.camera[i].known()) {
      tracked.trajectory.frames[i].camera_px = clip.camera[i].displacement_px;
      tracked.trajectory.frames[i].camera_residual_px = clip.camera[i].residual_px;
    }
  if (options.keep_marks)  // the regression misses them by a tenth of a pixel
    for (const TrajectoryFrame& mark : marks.frames)
      for (const BodyPart part : kBodyParts)
        if (mark[part].present())
          tracked.trajectory.frames[static_cast<std::size_t>(mark.frame - first)][part].p_px =
              mark[part].p_px;
  if (!marks.treadmill && movement(marks.movement).repeats)
    tracked.trajectory.treadmill =
        is_treadmill(tracked.trajectory, video::body_size_px(marks), summary.prior.legs.period_s);
  return tracked;
}

Trajectory marks_of(const Keypoints& keypoints) {
  Trajectory marks;
  marks.video = keypoints.video;
  marks.video_sha256 = keypoints.video_sha256;
  marks.width_px = keypoints.width_px;
  marks.height_px = keypoints.height_px;
  marks.movement = keypoints.movement;
  marks.direction = keypoints.direction;
  marks.treadmill = keypoints.treadmill;
  marks.calibration_line = keypoints.calibration_line;
  if (keypoints.floor) {
    const Vector2d along = keypoints.floor->to_px - keypoints.floor->from_px;
    marks.floor_roll_rad = std::atan(along.y() / along.x());
  }
  for (const auto& [number, clicked] : keypoints.frames) {
    if (keypoints.trim && (number < keypoints.trim->first || number > keypoints.trim->last))
      continue;
    TrajectoryFrame frame;
    frame.frame = number;
    frame.time_s = clicked.time_s;
    bool any = false;
    for (const BodyPart part : kBodyParts) {
      const auto& click = clicked[part];
      if (!click) continue;
      any = true;
      switch (click->state) {
        case ClickState::seen:
          frame[part] = {click->p_px, Source::clicked, 1};
          break;
        case ClickState::estimated:
          frame[part] = {click->p_px, Source::hidden, kHiddenConfidence};
          break;
        case ClickState::absent:
          frame[part].source = Source::absent;
          break;
      }
    }
    if (any) marks.frames.push_back(frame);
  }
  return marks;
}

std::optional<Facing> facing(const Trajectory& points) {
  double forward = 0;  // of the knees in front of the line from pelvis to ankle
  for (const TrajectoryFrame& frame : points.frames)
    for (const auto& [knee, ankle] : {std::pair(BodyPart::knee_r, BodyPart::ankle_r),
                                      std::pair(BodyPart::knee_l, BodyPart::ankle_l)}) {
      const Vector2d up = frame[BodyPart::pelvis].p_px - frame[ankle].p_px,
                     shank = frame[knee].p_px - frame[ankle].p_px;
      const double bend = up.x() * shank.y() - up.y() * shank.x();
      if (std::isfinite(bend)) forward += bend;
    }
  if (forward == 0) return std::nullopt;
  return forward > 0 ? Facing::right : Facing::left;
}

}  // namespace stride::tracking
