#pragma once

#include <optional>

#include "calibrate/fit/fit.h"

namespace stride::fit {

/// What a user may know about the runner; at most one is given.
struct RunnerSize {
  std::optional<double> height_m, leg_m, metres_per_pixel;
};

/// Throws Error if two are given, or one is not that of a person or a character.
FitOptions fit_options(const RunnerSize& size);

}  // namespace stride::fit
