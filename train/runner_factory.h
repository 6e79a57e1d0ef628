#pragma once

#include "train/options.h"
#include "train/training.h"

namespace stride {

/// The runner of these options. Slots of training may start on the reference motion; the one for
/// evaluation starts as the rules say. `potential` (or null) says what a foot is. Throws Error
/// naming the option, or why the engine refuses the model.
EnvironmentFactory make_runners(const EnvironmentOptions& options, const Potential* potential);

}  // namespace stride
