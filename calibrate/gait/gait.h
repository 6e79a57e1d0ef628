#pragma once

#include <vector>

#include "calibrate/fit/fit.h"
#include "calibrate/runner/calibrated.h"

namespace stride::gait {

/// A fitted stride on the model, and its stance.
struct Gait {
  double foot_strike = 0;      // phase of the fit at which the right foot strikes
  bool walks = false;          // rather than runs
  double duty = 0;             // share of the stride with a foot on the ground
  double speed_m_s = 0;        // of the runner: that of the stance foot relative to the pelvis
  double pelvis_height_m = 0;  // mean, of the model's pelvis origin, its lowest foot on the ground
  double vertical_oscillation_m = 0;  // peak to peak of the pelvis' height, on the model
  double correlation = 0;  // correlation of hip and knee with the human mean at that foot strike
};

/// The nine coordinates of the model at a phase of the fit; pelvis_tx is 0, pelvis_ty without its
/// mean.
CalibratedSample pose_at(const fit::StrideFit& fit, const SagittalModel& model, double phase);

/// Foot strike is where hip and knee match those of measured runners at theirs best; toe off is
/// where the foot leaves its height in stance.
Gait analyse_gait(const fit::StrideFit& fit, const SagittalModel& model);

/// Without labelled toes, sets the ankle angles to those of measured runners.
void fill_unseen_ankles(fit::StrideFit& fit);

/// The clip on the proportions of the model: every 0.01 s from its first labelled point to its
/// last, at least one stride, with standard deviations. The caller sets source and verdict.
CalibratedTrajectory retarget(const fit::StrideFit& fit, const Gait& gait,
                              const SagittalModel& model, const fit::Marks& observations);

}  // namespace stride::gait
