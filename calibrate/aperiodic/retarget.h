#pragma once

#include "calibrate/aperiodic/flight.h"
#include "calibrate/runner/calibrated.h"

namespace stride::aperiodic {

/// The scale of a passage: the flight's free fall, and the leg's length or a calibration line,
/// weighted.
struct Scale {
  double px_per_m = 0, relative_sd = 0;
  double leg_m = 0;         // that it makes of the runner's leg
  double disagreement = 0;  // of free fall against that, in standard deviations; + too large
  double fall_factor = 1;   // with how many g a runner of that size would fall
};

Scale scale_of(const PassageFit& fit, const Flight& flight, const fit::FitOptions& options);

/// The passage on the proportions of the model: every 0.01 s, with standard deviations. Standing,
/// the lowest contact point of the model touches the ground; in flight its centre of mass falls
/// with 9.81 m/s² for as long as the runner's. The caller sets source and verdict.
CalibratedTrajectory retarget(const PassageFit& fit, const GroundPath& path, const Flight& flight,
                              const Scale& scale, const SagittalModel& model,
                              const fit::Marks& observations);

}  // namespace stride::aperiodic
