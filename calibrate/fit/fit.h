#pragma once

#include "calibrate/fit/stride_fit.h"

namespace stride::fit {

/// The main path. Never throws for what a clip shows.
StrideFit fit_stride(const Marks& observations, const SagittalModel& model,
                     const FitOptions& options = {});

}  // namespace stride::fit
