#pragma once

#include "calibrate/calibrated.h"
#include "calibrate/fit.h"
#include "calibrate/gait.h"
#include "calibrate/verdict.h"
#include "extract/trajectory.h"

namespace stride {

/// Everything that is found out about a clip.
struct Calibration {
  Verdict verdict;
  Marks observations;
  StrideFit fit;  // ok false where the clip was refused before or by the fit
  Gait gait;
  CalibratedTrajectory run;  // on the model's proportions; no samples if there is no fit
};

/// Trajectory in pixels → run in metres on the model. A clip that cannot be explained is a value:
/// `verdict.refused`.
Calibration calibrate(const Trajectory& trajectory, const SagittalModel& model,
                      const FitOptions& options = {});

}  // namespace stride
