#pragma once

#include "calibrate/calibrate.h"

namespace stride {

/// Positions of the fitted parts in every frame of the trajectory, px.
Trajectory fitted_points(const Trajectory& trajectory, const SagittalModel& model,
                         const Calibration& calibration);

/// The fitted runner in the image, px: in every frame of `trajectory` each part that was labelled
/// in it. The confidence is at most 0.3, as for points that were not seen:
///
///     0.3 / (1 + (30 sd / leg)²),  sd of the part about the pelvis, leg: hip to ankle
///
/// Needs a fit that is ok. `stride track --prior` reads it.
Trajectory fitted_px(const Trajectory& trajectory, const SagittalModel& model,
                     const Calibration& result);

}  // namespace stride
