#pragma once

#include "calibrate/fit/fit.h"
#include "calibrate/gait/gait.h"
#include "calibrate/gait/verdict.h"
#include "calibrate/runner/calibrated.h"
#include "extract/skeleton/trajectory.h"

namespace stride {

/// The result of a calibration.
struct Calibration {
  gait::Verdict verdict;
  fit::Marks observations;
  fit::StrideFit fit;  // ok is false if the clip was refused before or by the fit
  gait::Gait gait;
  CalibratedTrajectory run;  // on the model's proportions; without samples if there is no fit
};

/// Converts a trajectory in pixels to a run in metres on the model. A clip that cannot be explained
/// is not an error: see `verdict.refused`.
Calibration calibrate(const Trajectory& trajectory, const SagittalModel& model,
                      const fit::FitOptions& options = {});

}  // namespace stride
