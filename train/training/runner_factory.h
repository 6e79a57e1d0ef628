#pragma once

#include "train/training/demonstration.h"
#include "train/training/training.h"

namespace stride::training {

/// The runner of these options. Slots of training may start on the reference motion; the one for
/// evaluation starts as the rules say. The potential says what a foot is. Throws Error naming the
/// option, or why the engine refuses the model.
EnvironmentFactory make_runners(const EnvironmentOptions& options,
                                const Demonstration& demonstration);

}  // namespace stride::training
