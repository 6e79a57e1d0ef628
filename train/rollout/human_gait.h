#pragma once

#include <optional>

#include "train/rollout/gait_summary.h"

namespace stride::rollout {

/// From the mean − 2 SD to the mean + 2 SD of human runners.
struct GaitBand {
  double low = 0, high = 0;
  bool holds(double value) const { return value >= low && value <= high; }
};

/// Gait parameters of human runners at a speed. Sources: cadence and duty factor at 2.5, 3.5 and
/// 4.5 m/s from 28 runners (Fukuchi, Fukuchi, Duarte 2017, PeerJ 5:e3298), linear between and
/// beyond; the spread of the cadence, 9 steps/min, from 860 runners at 2.75 m/s (Malisoux et al.
/// 2023). Step length and flight follow: 60 v / cadence, 1 − 2 · duty factor.
struct HumanGait {
  GaitBand cadence_per_min, step_length_m, duty_factor, flight_share;
};

/// Nothing below 2 m/s (walking) and above 5.5 m/s (sprinting).
std::optional<HumanGait> human_gait(double speed_m_s);

/// GaitSummary::leg_phase in words; from 0.4 on the legs take turns, up to 0.1 they hop.
const char* leg_pattern(double leg_phase);

}  // namespace stride::rollout
