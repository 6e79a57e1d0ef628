#pragma once

#include <vector>

#include "extract/skeleton/trajectory.h"
#include "extract/tracking/gaussian_process/gait_prior.h"
#include "extract/tracking/optical_flow.h"

namespace stride::tracking {

/// One part on one frame as a mark, the flow or a prediction has it.
struct Measurement {
  BodyPart part;
  int frame;
  Eigen::Vector2d p_px;
  Eigen::Vector2d variance_px2;
  bool doubtful = true;  // loses weight when it disagrees with the rest
  double weight = 1;     // by agreement
  bool inlier = false;   // the flow, and it led back
  double round_trip_px = 0;
  int since_frame = -1;  // if set: p_px is the way since that frame
};

/// For the regression; `times_s[i]` is the time of frame i.
gaussian_process::Observations observations_of(const std::vector<Measurement>& measurements,
                                               const std::vector<double>& times_s);

/// The marks, with a variance of 1 px².
std::vector<Measurement> measurements_of(const Trajectory& marks);

/// Gives marks the variance that the fit found, larger where one is less certain. They come first
/// among the readings, in the order of readings_of().
void weigh_marks(std::vector<Measurement>& measurements, const Trajectory& marks,
                 const gaussian_process::GaitPrior& prior);

/// Adds a prediction by others as weak readings: its variance is how far it is from the marks,
/// beyond their noise.
void add_prediction(std::vector<Measurement>& measurements, const Trajectory& prediction,
                    const Trajectory& marks, const gaussian_process::GaitPrior& prior);

/// Mean square per coordinate by which the flow missed the next mark: how far it can be trusted on
/// this part of this clip. NaN if the part was never followed.
double mean_squared_miss(const std::vector<FlowStretch>& stretches, BodyPart part);

/// Adds the steps where the flow was believed, from either side.
void add_flow(std::vector<Measurement>& measurements, const std::vector<FlowStretch>& stretches,
              const gaussian_process::GaitPrior& prior);

/// Takes weight from readings that disagree with the estimates (Student's t by reweighting);
/// `estimates[0]` is of `first_frame`.
void reweigh(std::vector<Measurement>& measurements, const gaussian_process::Estimates& estimates,
             int first_frame);

}  // namespace stride::tracking
