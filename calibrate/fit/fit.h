#pragma once

#include "calibrate/fit/solver/stride_fit.h"

namespace stride::fit {

/// The main path. Never throws because of a clip's content.
StrideFit fit_stride(const Marks& observations, const SagittalModel& model,
                     const FitOptions& options = {});

}  // namespace stride::fit
