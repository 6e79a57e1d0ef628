#pragma once

#include "calibrate/calibrate.h"

namespace stride {

/// Where the fit has the parts in every frame of the trajectory, px.
Trajectory fitted_points(const Trajectory& trajectory, const SagittalModel& model,
                         const Calibration& calibration);

/// The fitted runner in the image: in every frame of `trajectory` each part that was marked in it,
/// px. The confidence is 0.3 or less, as of points that no picture showed:
///
///     0.3 / (1 + (30 sd / leg)²),  sd of the part about the pelvis, leg: hip to ankle
///
/// Needs `result.fit.ok`. `stride track --prior` reads it.
Trajectory fitted_px(const Trajectory& trajectory, const SagittalModel& model,
                     const Calibration& result);

}  // namespace stride
