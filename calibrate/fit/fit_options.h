#pragma once

#include <optional>

#include "calibrate/fit/fit.h"

namespace stride::fit {

/// The known size of the runner; at most one member is set.
struct RunnerSize {
  std::optional<double> height_m, leg_m, metres_per_pixel;
};

/// Throws Error if two are set, or one is implausible for a person or a character.
FitOptions fit_options(const RunnerSize& size);

}  // namespace stride::fit
