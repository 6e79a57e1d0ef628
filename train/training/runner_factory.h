#pragma once

#include "train/training/demonstration.h"
#include "train/training/training.h"

namespace stride::training {

/// Makes runners with these options. Training slots may start from the reference motion; the one
/// for evaluation starts by the rules. The potential defines what a foot is. Throws Error naming
/// the option, or why the engine refuses the model.
EnvironmentFactory make_runners(const EnvironmentOptions& options,
                                const Demonstration& demonstration);

}  // namespace stride::training
