#include "extract/readings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stride {
namespace {

using Eigen::Vector2d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kClicked = 0.99;           // marks of at least this confidence are a person's
constexpr double kStudentDof = 3;           // tails of the flow's and the detectors' errors
constexpr double kLeastStepVariance = 0.1;  // px², of a step of the flow
constexpr double kMostOfMarks = 0.75;       // of what the flow misses, by the noise of the marks
constexpr double kFramesAlike = 10;         // of a prediction: their errors are one
constexpr double kLeastPredictionVariance = 0.02;  // px²

double noise_px(const GaitPrior& prior, BodyPart part) {
  const bool trunk = part == BodyPart::pelvis || part == BodyPart::head;
  return trunk ? prior.trunk.noise_px : prior.legs.noise_px;
}

/// The steps of a stretch where the flow was believed, from either side.
void read_stretch(const FlowStretch& s, double part_miss, double noise,
                  std::vector<Reading>& readings) {
  const int length = s.last - s.first;
  const double own_miss = (s.forward_miss_px.squaredNorm() + s.backward_miss_px.squaredNorm()) / 4;
  // The marks at both ends are a part of the miss.
  const double miss = part_miss + own_miss,
               drift = std::max(miss - 3 * noise * noise, (1 - kMostOfMarks) * miss);
  // The steps of a stretch share their error: as much again as if they were independent, and more.
  const double step_variance = kLeastStepVariance + 2 * drift / length;
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

}  // namespace

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

std::vector<Reading> readings_of(const Trajectory& marks) {
  std::vector<Reading> readings;
  for (const TrajectoryFrame& frame : marks.frames)
    for (const BodyPart part : kBodyParts)
      if (frame[part].present())
        readings.push_back({part, frame.frame, frame[part].p_px, Vector2d::Ones(),
                            frame[part].confidence < kClicked});
  return readings;
}

void weigh_marks(std::vector<Reading>& readings, const Trajectory& marks, const GaitPrior& prior) {
  auto reading = readings.begin();
  for (const TrajectoryFrame& frame : marks.frames)
    for (const BodyPart part : kBodyParts) {
      if (!frame[part].present()) continue;
      const double noise = noise_px(prior, part);
      const double certainty = std::clamp(frame[part].confidence, 0.1, 1.0);
      (reading++)->variance_px2.setConstant(std::pow(noise / certainty, 2));
    }
}

void add_prediction(std::vector<Reading>& readings, const Trajectory& prediction,
                    const Trajectory& marks, const GaitPrior& prior) {
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
    // Of the distance from the marks, what their noise does not explain. The error of a fit is the
    // same in frames that follow one another and in every stride: each says little of its own, and
    // the less the worse the fit is than the marks.
    const double noise = std::pow(noise_px(prior, part), 2);
    const Eigen::Array2d own_px2 =
        (squared.array() / n - 0.7 * noise).max(std::max(0.15 * noise, kLeastPredictionVariance));
    const Vector2d variance_px2 = kFramesAlike * own_px2 * (1 + own_px2 / noise);
    for (const TrajectoryFrame& frame : prediction.frames)
      if (frame.frame >= first && frame.frame <= last && frame[part].present())
        readings.push_back({part, frame.frame, frame[part].p_px, variance_px2});
  }
}

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

void add_flow(std::vector<Reading>& readings, const std::vector<FlowStretch>& stretches,
              const GaitPrior& prior) {
  for (const BodyPart part : kBodyParts) {
    const double miss = mean_squared_miss(stretches, part);
    for (const FlowStretch& stretch : stretches)
      if (stretch.part == part) read_stretch(stretch, miss, noise_px(prior, part), readings);
  }
}

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

}  // namespace stride
