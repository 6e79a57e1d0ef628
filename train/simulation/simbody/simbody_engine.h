#pragma once

// C++17-clean and free of Simbody.

#include <memory>

#include "train/simulation/engine/engine.h"

namespace stride::simbody {

/// The reference: Simbody 3.7's multibody dynamics under the shared laws of muscles, contact and
/// limits. Throws Error if the model moves out of the sagittal plane.
std::unique_ptr<simulation::Engine> make_simbody_engine(const osim::Model& model,
                                                        const simulation::EngineOptions& options);

/// Whether the library that talks to Simbody was compiled with NDEBUG. It must not be: Debian's
/// libsimbody is built without, and its types are laid out accordingly.
bool simbody_engine_defines_ndebug();

}  // namespace stride::simbody
