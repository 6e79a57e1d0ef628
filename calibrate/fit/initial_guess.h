#pragma once

#include <vector>

#include "calibrate/fit/marks.h"
#include "calibrate/runner/runner.h"
#include "extract/skeleton/stride_period.h"

namespace stride::fit {

/// Candidates of the stride's period, best first; at most `count`. Empty if there are too few
/// marks.
std::vector<StridePeriod> guess_periods(const Marks& observations, int count);

/// Initial guess of limbs and angles for a period, by linear least squares. `leg_m` sets the scale.
Runner guess_runner(const Marks& observations, const SagittalModel& model, double period_s,
                    double leg_m);

}  // namespace stride::fit
