#pragma once

#include "calibrate/aperiodic/retarget.h"
#include "calibrate/fit/fit.h"
#include "calibrate/gait/gait.h"
#include "calibrate/gait/verdict.h"
#include "calibrate/runner/calibrated.h"
#include "extract/skeleton/trajectory.h"

namespace stride {

/// The fit of a movement that does not repeat.
struct AperiodicCalibration {
  aperiodic::PassageFit fit;
  aperiodic::GroundPath path;
  aperiodic::Flight flight;
  aperiodic::Scale scale;
};

/// The result of a calibration.
struct Calibration {
  gait::ClipVerdict verdict;
  fit::Marks observations;
  fit::StrideFit fit;  // ok is false if the clip was refused before or by the fit
  gait::Gait gait;
  std::optional<AperiodicCalibration> aperiodic;  // instead of `fit` and `gait`
  bool scaled_by_line = false;                    // a calibration line, not the leg, sets the scale
  CalibratedTrajectory run;  // on the model's proportions; without samples if there is no fit

  /// Whether there is a run, refused or not.
  bool ok() const { return !run.samples.empty(); }
};

/// Converts a trajectory in pixels to a run in metres on the model. A clip that cannot be explained
/// is not an error: see `verdict.refused`.
Calibration calibrate(const Trajectory& trajectory, const SagittalModel& model,
                      const fit::FitOptions& options = {});

}  // namespace stride
