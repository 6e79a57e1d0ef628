#pragma once

#include <vector>

#include "calibrate/fit/marks.h"
#include "calibrate/runner/runner.h"

namespace stride::fit {

/// A stride found in the marks without any model: knees and ankles from the pelvis as Fourier
/// series of one period, left = right half a cycle later.
struct PeriodGuess {
  double period_s = 0;
  double explained = 0;  // part of the robust variance of ankles and knees that the period explains
};

/// Candidates, best first; at most `count`, each at least 15 % from the others. Empty if there are
/// too few marks. Deterministic: every period from 0.2 s to the length of the clip is tried.
std::vector<PeriodGuess> guess_periods(const Marks& observations, int count);

/// Limbs and angles for a period by linear least squares: where the fit starts. `leg_m` sets the
/// scale.
Runner guess_runner(const Marks& observations, const SagittalModel& model, double period_s,
                    double leg_m);

}  // namespace stride::fit
