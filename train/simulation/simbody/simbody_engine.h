#pragma once

// C++17-clean and free of Simbody.

#include <memory>

#include "train/simulation/engine/engine.h"

namespace stride::simbody {

/// The reference engine: Simbody 3.7's multibody dynamics with the shared laws of muscles, contact
/// and limits. Throws Error if the model leaves the sagittal plane.
std::unique_ptr<simulation::Engine> make_simbody_engine(const osim::Model& model,
                                                        const simulation::EngineOptions& options);

/// Whether this library was compiled with NDEBUG. It must not be, because Debian's libsimbody is
/// built without it and its type layout depends on it.
bool simbody_engine_defines_ndebug();

}  // namespace stride::simbody
