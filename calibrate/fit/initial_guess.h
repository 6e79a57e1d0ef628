#pragma once

#include <vector>

#include "calibrate/fit/solver/marks.h"
#include "calibrate/runner/runner.h"

namespace stride::fit {

/// A stride fitted to the points without a body model: knees and ankles relative to the pelvis as
/// Fourier series of one period, left = right half a cycle later.
struct PeriodGuess {
  double period_s = 0;
  double explained = 0;  // share of the robust variance explained by the period
};

/// Candidates, best first; at most `count`, at least 15 % apart. Empty if there are too few points.
/// Deterministic: tries every period from 0.2 s to the length of the clip.
std::vector<PeriodGuess> guess_periods(const Marks& observations, int count);

/// Initial guess of limbs and angles for a period, by linear least squares. `leg_m` sets the scale.
Runner guess_runner(const Marks& observations, const SagittalModel& model, double period_s,
                    double leg_m);

}  // namespace stride::fit
