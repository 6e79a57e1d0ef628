#include "extract/track.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "extract/camera.h"
#include "extract/error.h"
#include "extract/flow.h"

namespace stride {
namespace {

using Eigen::Vector2d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kClicked = 0.99;   // marks of at least this confidence are a person's
constexpr double kFlowStart = 0.6;  // marks of at least this confidence are followed
constexpr double kPriorOnly = 0.3;  // most confidence that the prior alone can give
constexpr double kStudentDof = 3;   // tails of the flow's and the detectors' errors
constexpr int kReweightings = 3;
constexpr double kLeastStepVariance = 0.1;  // px², of a step of the flow

/// One part on one frame as a mark, the flow or a prediction has it.
struct Reading {
  BodyPart part;
  int frame;
  Vector2d p_px;
  Vector2d variance_px2;
  bool doubtful = true;   // loses weight when it disagrees with the rest
  double weight = 1;      // by agreement
  bool believed = false;  // the flow, and it led back
  double round_trip_px = 0;
  int since_frame = -1;  // if set: p_px is the way since that frame
};

Observations observations_of(const std::vector<Reading>& readings,
                             const std::vector<double>& times_s) {
  Observations observations;
  for (const Reading& r : readings) {
    Observation& o = observations[index(r.part)].emplace_back();
    o.time_s = times_s[static_cast<std::size_t>(r.frame)];
    o.p_px = r.p_px;
    o.variance_px2 = r.variance_px2 / r.weight;
    if (r.since_frame >= 0) o.since_s = times_s[static_cast<std::size_t>(r.since_frame)];
  }
  return observations;
}

double noise_px(const GaitPrior& prior, BodyPart part) {
  const bool trunk = part == BodyPart::pelvis || part == BodyPart::head;
  return trunk ? prior.trunk.noise_px : prior.legs.noise_px;
}

std::vector<Reading> readings_of_marks(const Trajectory& marks) {
  std::vector<Reading> readings;
  for (const TrajectoryFrame& frame : marks.frames)
    for (const BodyPart part : kBodyParts)
      if (frame[part].present())
        readings.push_back({part, frame.frame, frame[part].p_px, Vector2d::Ones(),
                            frame[part].confidence < kClicked});
  return readings;
}

/// The variance that the fit found, larger where a mark is less certain.
void weigh_marks(std::vector<Reading>& readings, const Trajectory& marks, const GaitPrior& prior,
                 bool exactly) {
  auto reading = readings.begin();
  for (const TrajectoryFrame& frame : marks.frames)
    for (const BodyPart part : kBodyParts) {
      if (!frame[part].present()) continue;
      const double noise = exactly ? 0.02 : noise_px(prior, part);
      const double certainty = std::clamp(frame[part].confidence, 0.1, 1.0);
      (reading++)->variance_px2.setConstant(std::pow(noise / certainty, 2));
    }
}

/// A prediction by others as weak readings: its variance is how far it is from the marks.
void add_prediction(std::vector<Reading>& readings, const Trajectory& prediction,
                    const Trajectory& marks) {
  const int first = marks.frames.front().frame, last = marks.frames.back().frame;
  for (const BodyPart part : kBodyParts) {
    Vector2d squared = Vector2d::Zero();
    int n = 0;
    for (const TrajectoryFrame& frame : prediction.frames)
      for (const TrajectoryFrame& mark : marks.frames)
        if (mark.frame == frame.frame && mark[part].present() && frame[part].present()) {
          squared += (mark[part].p_px - frame[part].p_px).cwiseAbs2();
          ++n;
        }
    if (n < 3) continue;
    const Vector2d variance_px2 = (2 * squared / n).cwiseMax(0.25);
    for (const TrajectoryFrame& frame : prediction.frames)
      if (frame.frame >= first && frame.frame <= last && frame[part].present())
        readings.push_back({part, frame.frame, frame[part].p_px, variance_px2});
  }
}

/// Median distance of the farthest part from the pelvis: the size of what is followed.
double body_size_px(const Trajectory& marks) {
  std::vector<double> sizes;
  for (const TrajectoryFrame& frame : marks.frames) {
    double size = 0;
    for (const BodyPart part : kBodyParts)
      if (frame[part].present() && frame[BodyPart::pelvis].present())
        size = std::max(size, (frame[part].p_px - frame[BodyPart::pelvis].p_px).norm());
    if (size > 0) sizes.push_back(size);
  }
  if (sizes.empty()) return 90;
  const auto middle = sizes.begin() + static_cast<long>(sizes.size() / 2);
  std::ranges::nth_element(sizes, middle);
  return *middle;
}

FlowOptions flow_options(double size_px) {
  FlowOptions options;
  const double scale = std::clamp(size_px / 90, 0.7, 2.0);  // tuned at 60–120 px
  options.window_px = 2 * static_cast<int>(std::lround(10 * scale)) + 1;
  options.pyramid_levels = scale > 1.5 ? 4 : 3;
  options.round_trip_px = scale;
  options.step_px = 8 * scale;
  return options;
}

/// Mean square per coordinate by which the flow missed the next mark: how far it can be trusted on
/// this part of this clip. NaN if the part was never followed.
double mean_squared_miss(const std::vector<FlowStretch>& stretches, BodyPart part) {
  double sum = 0;
  int n = 0;
  for (const FlowStretch& s : stretches) {
    if (s.part != part) continue;
    sum += s.forward_miss_px.squaredNorm() + s.backward_miss_px.squaredNorm();
    n += 4;
  }
  return n > 0 ? sum / n : kNan;
}

/// The steps of a stretch where the flow was believed, from either side.
void read_stretch(const FlowStretch& s, double part_miss, std::vector<Reading>& readings) {
  const int length = s.last - s.first;
  const double own_miss = (s.forward_miss_px.squaredNorm() + s.backward_miss_px.squaredNorm()) / 4;
  // The steps of a stretch share their error: as much again as if they were independent, and more.
  const double step_variance = kLeastStepVariance + 2 * (part_miss + own_miss) / length;
  for (int i = 0; i < length; ++i) {
    const FlowStep &a = s.forward[static_cast<std::size_t>(i)],
                   &b = s.backward[static_cast<std::size_t>(i)];
    if (!a.believed && !b.believed) continue;
    const double share = a.believed && b.believed ? 0.5 : a.believed ? 1 : 0;
    const Vector2d apart = share == 0.5 ? Vector2d(a.way_px - b.way_px) : Vector2d::Zero();
    Reading& reading = readings.emplace_back();
    reading.part = s.part;
    reading.since_frame = s.first + i;
    reading.frame = s.first + i + 1;
    reading.p_px = share * a.way_px + (1 - share) * b.way_px;
    reading.variance_px2.setConstant(step_variance * (share == 0.5 ? 1 : 2));
    reading.variance_px2 += apart.cwiseAbs2() / 4;
    reading.round_trip_px = share * a.round_trip_px + (1 - share) * b.round_trip_px;
    reading.believed = true;
  }
}

/// Where the runner is, arms and head included, to be left out of the background.
cv::Rect runner_box(const std::array<Estimate, kBodyPartCount>& parts, double size_px) {
  Vector2d low = parts[index(BodyPart::pelvis)].p_px, high = low;
  for (const Estimate& part : parts)
    if (part.p_px.allFinite()) {
      low = low.cwiseMin(part.p_px);
      high = high.cwiseMax(part.p_px);
    }
  low -= Vector2d(0.4, 1.1) * size_px;  // above the pelvis trunk and head
  high += Vector2d(0.4, 0.3) * size_px;
  return {cv::Point(static_cast<int>(low.x()), static_cast<int>(low.y())),
          cv::Point(static_cast<int>(high.x()), static_cast<int>(high.y()))};
}

/// What the frames from the first mark to the last show.
struct Seen {
  std::vector<FlowStretch> stretches;
  std::vector<CameraStep> camera;  // of each frame; empty if it was not asked for
};
Seen look(const Trajectory& marks, const Estimates& expected, const FrameSource& frames,
          const TrackOptions& options) {
  Seen seen;
  if (!options.flow && !options.camera) return seen;
  const double size_px = body_size_px(marks);
  CameraTracker camera;
  const int first = marks.frames.front().frame, last = marks.frames.back().frame;
  FlowTracker tracker(flow_options(size_px), [&](BodyPart part, int frame) {
    return expected[static_cast<std::size_t>(frame - first)][index(part)].p_px;
  });
  auto mark = marks.frames.begin();
  VideoFrame frame;
  while (frame.index < last && frames(frame)) {
    if (frame.index < first) continue;
    Places places;
    if (mark->frame == frame.index) {
      for (const BodyPart part : kBodyParts)
        if ((*mark)[part].present() && (*mark)[part].confidence >= kFlowStart)
          places[index(part)] = (*mark)[part].p_px;
      ++mark;
    }
    if (options.flow) tracker.add(frame.index, frame.image, places);
    if (options.camera) {
      const auto& runner = expected[static_cast<std::size_t>(frame.index - first)];
      seen.camera.push_back(camera.add(frame.image, runner_box(runner, size_px)));
    }
    if (options.progress) options.progress(frame.index, last);
  }
  seen.stretches = tracker.stretches();
  return seen;
}

/// The runner stays where he is before a background that rests: within half a leg a stride.
std::optional<bool> is_treadmill(const Trajectory& t, double size_px, double period_s) {
  Vector2d way = Vector2d::Zero();  // of the pelvis before the background
  double rest_px = 0;
  int known = 0;
  for (std::size_t i = 1; i < t.frames.size(); ++i) {
    const TrajectoryFrame &a = t.frames[i - 1], &b = t.frames[i];
    if (!b.camera_px.allFinite()) continue;
    way += b[BodyPart::pelvis].p_px - a[BodyPart::pelvis].p_px - b.camera_px;
    rest_px += b.camera_px.norm();
    ++known;
  }
  if (known < static_cast<int>(t.frames.size()) / 2) return std::nullopt;
  const double strides = known / t.rate_hz / period_s;
  return std::abs(way.x()) < 0.5 * size_px * strides && rest_px < 0.5 * size_px * strides;
}

/// Takes weight from readings that disagree with the estimates (Student's t by reweighting).
void reweigh(std::vector<Reading>& readings, const Estimates& estimates, int first_frame) {
  for (Reading& r : readings) {
    if (!r.doubtful) continue;
    const auto estimated = [&](int frame) {
      return estimates[static_cast<std::size_t>(frame - first_frame)][index(r.part)].p_px;
    };
    Vector2d now_px = estimated(r.frame);
    if (r.since_frame >= 0) now_px -= estimated(r.since_frame);
    const double z = ((now_px - r.p_px).array().square() / r.variance_px2.array()).mean();
    r.weight = (kStudentDof + 1) / (kStudentDof + z);
  }
}

/// The part was said to be absent on the marked frames around this one.
bool is_absent(const Trajectory& marks, BodyPart part, int frame) {
  const Point *before = nullptr, *after = nullptr;
  for (const TrajectoryFrame& mark : marks.frames) {
    const Point& point = mark[part];
    if (!point.present() && point.confidence == 0) continue;  // nothing was said
    if (mark.frame <= frame) before = &point;
    if (mark.frame >= frame && after == nullptr) after = &point;
  }
  const auto absent = [](const Point* p) { return p == nullptr || !p->present(); };
  return (before != nullptr || after != nullptr) && absent(before) && absent(after);
}

double median_rate_hz(const std::vector<double>& times_s) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times_s.size(); ++i) steps.push_back(times_s[i] - times_s[i - 1]);
  if (steps.empty()) return 30;
  const auto middle = steps.begin() + static_cast<long>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  return 1 / *middle;
}

/// Estimates with the confidence that their sources deserve.
std::vector<TrajectoryFrame> assembled(const Trajectory& marks, const Estimates& estimates,
                                       const std::vector<Reading>& readings,
                                       const std::vector<double>& times_s, double size_px) {
  const int first = marks.frames.front().frame;
  std::vector<TrajectoryFrame> frames(estimates.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].frame = first + static_cast<int>(i);
    frames[i].time_s = times_s[static_cast<std::size_t>(frames[i].frame)];
    for (const BodyPart part : kBodyParts) {
      const Estimate& estimate = estimates[i][index(part)];
      if (!estimate.p_px.allFinite() || is_absent(marks, part, frames[i].frame)) continue;
      const double relative = 30 * std::sqrt(estimate.variance_px2.mean()) / size_px;
      frames[i][part] = {estimate.p_px, kPriorOnly / (1 + relative * relative)};
    }
  }
  for (const Reading& r : readings) {
    if (!r.believed) continue;
    const double led_back = std::exp(-0.5 * r.round_trip_px * r.round_trip_px);
    const double confidence = kPriorOnly + (1 - kPriorOnly) * std::min(1.0, r.weight) * led_back;
    for (const int frame : {r.since_frame, r.frame}) {
      Point& point = frames[static_cast<std::size_t>(frame - first)][r.part];
      if (point.present()) point.confidence = std::max(point.confidence, confidence);
    }
  }
  for (const TrajectoryFrame& mark : marks.frames)
    for (const BodyPart part : kBodyParts)
      if (mark[part].present())
        frames[static_cast<std::size_t>(mark.frame - first)][part].confidence =
            mark[part].confidence;
  return frames;
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

}  // namespace

Tracked track(const Trajectory& marks, const std::vector<double>& times_s,
              const FrameSource& frames, const TrackOptions& options) {
  check(marks, times_s);
  const int first = marks.frames.front().frame, last = marks.frames.back().frame;
  const std::vector<double> span_s(times_s.begin() + first, times_s.begin() + last + 1);
  Tracked tracked;
  TrackSummary& summary = tracked.summary;

  std::vector<Reading> readings = readings_of_marks(marks);
  summary.prior = fit_gait_prior(observations_of(readings, times_s));
  weigh_marks(readings, marks, summary.prior, options.keep_marks);
  if (options.prior) add_prediction(readings, *options.prior, marks);
  Estimates estimates = estimate(summary.prior, observations_of(readings, times_s), span_s);

  const Seen seen = look(marks, estimates, frames, options);
  const std::vector<FlowStretch>& stretches = seen.stretches;
  for (const BodyPart part : kBodyParts) {
    const double miss = mean_squared_miss(stretches, part);
    summary.miss_px[index(part)] = std::sqrt(2 * miss);
    for (const FlowStretch& stretch : stretches)
      if (stretch.part == part) read_stretch(stretch, miss, readings);
  }
  for (int round = 0; round < kReweightings; ++round) {
    estimates = estimate(summary.prior, observations_of(readings, times_s), span_s);
    reweigh(readings, estimates, first);
  }

  summary.marked_frames = static_cast<int>(marks.frames.size());
  std::size_t followed = 0, believed = 0;
  for (const FlowStretch& s : stretches) followed += static_cast<std::size_t>(s.last - s.first);
  for (const Reading& r : readings) believed += r.believed;
  summary.believed = followed > 0 ? static_cast<double>(believed) / followed : 0;
  tracked.trajectory = marks;
  tracked.trajectory.rate_hz = median_rate_hz(times_s);
  tracked.trajectory.frames = assembled(marks, estimates, readings, times_s, body_size_px(marks));
  for (std::size_t i = 0; i < seen.camera.size(); ++i)
    if (seen.camera[i].known()) {
      tracked.trajectory.frames[i].camera_px = seen.camera[i].way_px;
      tracked.trajectory.frames[i].camera_residual_px = seen.camera[i].residual_px;
    }
  if (!marks.treadmill)
    tracked.trajectory.treadmill =
        is_treadmill(tracked.trajectory, body_size_px(marks), summary.prior.legs.period_s);
  return tracked;
}

Trajectory marks_of(const Keypoints& keypoints) {
  Trajectory marks;
  marks.video = keypoints.video;
  marks.video_sha256 = keypoints.video_sha256;
  marks.width_px = keypoints.width_px;
  marks.height_px = keypoints.height_px;
  marks.direction = keypoints.direction;
  marks.treadmill = keypoints.treadmill;
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
      if (clicked.placed(part)) frame[part].p_px = click->p_px;
      frame[part].confidence = click->state == ClickState::estimated ? 0.5 : 1;
    }
    if (any) marks.frames.push_back(frame);
  }
  return marks;
}

std::string facing(const Trajectory& points) {
  double forward = 0;  // of the knees before the line from pelvis to ankle
  for (const TrajectoryFrame& frame : points.frames)
    for (const auto& [knee, ankle] : {std::pair(BodyPart::knee_r, BodyPart::ankle_r),
                                      std::pair(BodyPart::knee_l, BodyPart::ankle_l)}) {
      const Vector2d up = frame[BodyPart::pelvis].p_px - frame[ankle].p_px,
                     shank = frame[knee].p_px - frame[ankle].p_px;
      const double bend = up.x() * shank.y() - up.y() * shank.x();
      if (std::isfinite(bend)) forward += bend;
    }
  return forward > 0 ? "right" : forward < 0 ? "left" : "";
}

VideoTimes video_times(const std::filesystem::path& file, double slow_motion) {
  Video video(file, slow_motion);
  VideoTimes times{video.info(), {}, {}};
  VideoFrame frame;
  while (video.read(frame)) times.times_s.push_back(frame.time_s);
  times.shortfall = video.shortfall();
  return times;
}

}  // namespace stride
