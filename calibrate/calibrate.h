#pragma once

#include "calibrate/fit/fit.h"
#include "calibrate/gait/gait.h"
#include "calibrate/gait/verdict.h"
#include "calibrate/runner/calibrated.h"
#include "extract/skeleton/trajectory.h"

namespace stride {

/// Everything that is found out about a clip.
struct Calibration {
  gait::Verdict verdict;
  fit::Marks observations;
  fit::StrideFit fit;  // ok false where the clip was refused before or by the fit
  gait::Gait gait;
  CalibratedTrajectory run;  // on the model's proportions; no samples if there is no fit
};

/// Trajectory in pixels → run in metres on the model. A clip that cannot be explained is a value:
/// `verdict.refused`.
Calibration calibrate(const Trajectory& trajectory, const SagittalModel& model,
                      const fit::FitOptions& options = {});

}  // namespace stride
