#include "extract/tracking/measurements.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr double kStudentDof = 3;  // degrees of freedom of the errors of flow and detectors
constexpr double kLeastStepVariance = 0.1;  // px², of a step of the flow
constexpr double kMostOfMarks = 0.75;       // of what the flow misses, by the noise of the marks
constexpr double kFramesAlike = 10;         // of a prediction: their errors are correlated
constexpr double kLeastPredictionVariance = 0.02;  // px²

double noise_px(const gaussian_process::GaitPrior& prior, BodyPart part) {
  return !row(part).side ? prior.trunk.noise_px : prior.legs.noise_px;
}

/// The inlier displacements between two labelled points, from both sides.
void read_stretch(const FlowStretch& s, double part_miss, double noise,
                  std::vector<Measurement>& measurements) {
  const int length = s.last - s.first;
  const double own_miss = (s.forward_miss_px.squaredNorm() + s.backward_miss_px.squaredNorm()) / 4;
  // The noise of both labelled points is part of the miss.
  const double miss = part_miss + own_miss,
               drift = std::max(miss - 3 * noise * noise, (1 - kMostOfMarks) * miss);
  // The displacements between two points have correlated errors, so their variance is increased.
  const double step_variance = kLeastStepVariance + 2 * drift / length;
  for (int i = 0; i < length; ++i) {
    const FlowStep &a = s.forward[static_cast<std::size_t>(i)],
                   &b = s.backward[static_cast<std::size_t>(i)];
    if (!a.inlier && !b.inlier) continue;
    const double share = a.inlier && b.inlier ? 0.5 : a.inlier ? 1 : 0;
    const Vector2d apart =
        share == 0.5 ? Vector2d(a.displacement_px - b.displacement_px) : Vector2d::Zero();
    Measurement& measurement = measurements.emplace_back();
    measurement.part = s.part;
    measurement.since_frame = s.first + i;
    measurement.frame = s.first + i + 1;
    measurement.p_px = share * a.displacement_px + (1 - share) * b.displacement_px;
    measurement.variance_px2.setConstant(step_variance * (share == 0.5 ? 1 : 2));
    measurement.variance_px2 += apart.cwiseAbs2() / 4;
    measurement.round_trip_px = share * a.round_trip_px + (1 - share) * b.round_trip_px;
    measurement.inlier = true;
  }
}

}  // namespace

gaussian_process::Observations observations_of(const std::vector<Measurement>& measurements,
                                               const std::vector<double>& times_s) {
  gaussian_process::Observations observations;
  for (const Measurement& r : measurements) {
    gaussian_process::Observation& o = observations[index(r.part)].emplace_back();
    o.time_s = times_s[static_cast<std::size_t>(r.frame)];
    o.p_px = r.p_px;
    o.variance_px2 = r.variance_px2 / r.weight;
    if (r.since_frame >= 0) o.since_s = times_s[static_cast<std::size_t>(r.since_frame)];
  }
  return observations;
}

std::vector<Measurement> measurements_of(const Trajectory& marks) {
  std::vector<Measurement> measurements;
  for (const TrajectoryFrame& frame : marks.frames)
    for (const BodyPart part : kBodyParts)
      if (frame[part].present())
        measurements.push_back({part, frame.frame, frame[part].p_px, Vector2d::Ones(),
                                frame[part].source != Source::clicked});
  return measurements;
}

void weigh_marks(std::vector<Measurement>& measurements, const Trajectory& marks,
                 const gaussian_process::GaitPrior& prior) {
  auto measurement = measurements.begin();
  for (const TrajectoryFrame& frame : marks.frames)
    for (const BodyPart part : kBodyParts) {
      if (!frame[part].present()) continue;
      const double noise = noise_px(prior, part);
      const double certainty = std::clamp(frame[part].confidence, 0.1, 1.0);
      (measurement++)->variance_px2.setConstant(std::pow(noise / certainty, 2));
    }
}

void add_prediction(std::vector<Measurement>& measurements, const Trajectory& prediction,
                    const Trajectory& marks, const gaussian_process::GaitPrior& prior) {
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
    // The part of the distance from the labelled points that their noise does not explain. The
    // error of a fit is correlated over neighbouring frames and strides, so each frame has little
    // weight, the less the worse the fit.
    const double noise = std::pow(noise_px(prior, part), 2);
    const Eigen::Array2d own_px2 =
        (squared.array() / n - 0.7 * noise).max(std::max(0.15 * noise, kLeastPredictionVariance));
    const Vector2d variance_px2 = kFramesAlike * own_px2 * (1 + own_px2 / noise);
    for (const TrajectoryFrame& frame : prediction.frames)
      if (frame.frame >= first && frame.frame <= last && frame[part].present())
        measurements.push_back({part, frame.frame, frame[part].p_px, variance_px2});
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
  return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
}

void add_flow(std::vector<Measurement>& measurements, const std::vector<FlowStretch>& stretches,
              const gaussian_process::GaitPrior& prior) {
  for (const BodyPart part : kBodyParts) {
    const double miss = mean_squared_miss(stretches, part);
    for (const FlowStretch& stretch : stretches)
      if (stretch.part == part) read_stretch(stretch, miss, noise_px(prior, part), measurements);
  }
}

void reweigh(std::vector<Measurement>& measurements, const gaussian_process::Estimates& estimates,
             int first_frame) {
  for (Measurement& r : measurements) {
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

}  // namespace stride::tracking
