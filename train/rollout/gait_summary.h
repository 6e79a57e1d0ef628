#pragma once

#include <vector>

#include "train/rollout/rollout.h"

namespace stride::rollout {

/// A stance: the time of one foot on the ground.
struct FootContact {
  int side = 0;                   // 0 right, 1 left
  double start_s = 0, end_s = 0;  // of contact
  double start_x_m = 0;           // of the ankle at the strike
};

/// Stances of both feet in order of time: a foot is on the ground while it bears more than
/// task::bearing_N(); contacts shorter than 30 ms are ignored, and gaps shorter than 0.1 s, in
/// which a foot rebounds and does not swing. Stances cut by the beginning or the end of the rollout
/// are omitted.
std::vector<FootContact> foot_contacts(const Rollout& rollout, const osim::Model& model);

/// Gait parameters over the steps of a rollout; NaN where there are too few steps.
struct GaitSummary {
  double speed_m_s = 0;             // distance over time
  double last_speed_m_s = 0;        // over the last third of the time
  double cadence_per_min = 0;       // steps of either foot
  double step_length_m = 0;         // from the strike of one foot to that of the other
  double duty_factor = 0;           // share of a stride that a foot is on the ground
  double flight_share = 0;          // of the time with no foot on the ground
  double leg_phase = 0;             // between the legs' strikes, of a stride: ½ in turn, 0 at once
  double stride_s = 0;              // mean time between strikes of the same foot
  double peak_ground_force_bw = 0;  // largest vertical force on the runner, in body weights
};

GaitSummary gait_of(const Rollout& rollout, const osim::Model& model);

double weight_N(const osim::Model& model);

}  // namespace stride::rollout
