#pragma once

#include <vector>

#include "calibrate/fit/fit.h"
#include "calibrate/runner/calibrated.h"

namespace stride::gait {

/// What a fitted stride looks like on the model, and when its feet stand.
struct Gait {
  double foot_strike = 0;      // phase of the fit at which the right foot strikes
  bool walks = false;          // rather than runs
  double duty = 0;             // part of the stride that a foot is on the ground
  double speed_m_s = 0;        // of the runner: how fast the foot that stands goes back
  double pelvis_height_m = 0;  // mean, of the model's pelvis origin, its lowest foot on the ground
  double vertical_oscillation_m = 0;  // peak to peak of the pelvis' height, on the model
  double correlation = 0;  // correlation of hip and knee with the human mean at that foot strike
};

/// The nine coordinates of the model at a phase of the fit; pelvis_tx is 0, pelvis_ty without its
/// mean.
CalibratedSample pose_at(const fit::StrideFit& fit, const SagittalModel& model, double phase);

/// Foot strike is where hip and knee are most like those of measured runners at theirs; toe off,
/// where the foot leaves the height at which it stood.
Gait analyse_gait(const fit::StrideFit& fit, const SagittalModel& model);

/// If toes are not seen, gives the runner the ankles of measured runners.
void fill_unseen_ankles(fit::StrideFit& fit);

/// The clip on the proportions of the model: every 0.01 s from its first mark to its last, at
/// least one stride, with standard deviations. Source, verdict are the caller's.
CalibratedTrajectory retarget(const fit::StrideFit& fit, const Gait& gait,
                              const SagittalModel& model, const fit::Marks& observations);

}  // namespace stride::gait
