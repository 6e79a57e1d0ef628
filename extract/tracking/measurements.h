#pragma once

#include <vector>

#include "extract/skeleton/trajectory.h"
#include "extract/tracking/gaussian_process/gait_prior.h"
#include "extract/tracking/optical_flow.h"

namespace stride::tracking {

/// A measurement of a part on a frame: a click, a flow displacement or a prediction.
struct Measurement {
  BodyPart part;
  int frame;
  Eigen::Vector2d p_px;
  Eigen::Vector2d variance_px2;
  bool doubtful = true;  // weighted down when it disagrees with the rest
  double weight = 1;     // by its agreement with the rest
  bool inlier = false;   // flow: passed the forward–backward check
  double round_trip_px = 0;
  int since_frame = -1;  // if set: p_px is the displacement since that frame
};

/// The observations for the regression; `times_s[i]` is the time of frame i.
gaussian_process::Observations observations_of(const std::vector<Measurement>& measurements,
                                               const std::vector<double>& times_s);

/// The labelled points, with a variance of 1 px².
std::vector<Measurement> measurements_of(const Trajectory& marks);

/// Gives marks the variance that the fit found, larger where one is less certain. They come first
/// among the measurements, in the order of measurements_of().
void weigh_marks(std::vector<Measurement>& measurements, const Trajectory& marks,
                 const gaussian_process::GaitPrior& prior);

/// Adds an external prediction as weak measurements. Its variance is its mean square distance from
/// the labelled points beyond their noise.
void add_prediction(std::vector<Measurement>& measurements, const Trajectory& prediction,
                    const Trajectory& marks, const gaussian_process::GaitPrior& prior);

/// Mean square error, per coordinate, of the flow at the next labelled point: its reliability for
/// this part of this clip. NaN if the part was never followed.
double mean_squared_miss(const std::vector<FlowStretch>& stretches, BodyPart part);

/// Adds the inlier displacements of the flow, from both sides.
void add_flow(std::vector<Measurement>& measurements, const std::vector<FlowStretch>& stretches,
              const gaussian_process::GaitPrior& prior);

/// Reweights measurements that disagree with the estimates (Student's t). `estimates[0]` is of
/// `first_frame`.
void reweigh(std::vector<Measurement>& measurements, const gaussian_process::Estimates& estimates,
             int first_frame);

}  // namespace stride::tracking
