#pragma once

#include <memory>

#include "train/simulation/engine/engine.h"

namespace stride::planar {

/// The fast engine: the equations of dynamics.h, integrated by integrator.h. Throws Error with the
/// reason and the cure `--engine simbody` if it cannot represent the model.
std::unique_ptr<simulation::Engine> make_planar_engine(const osim::Model& model,
                                                       const simulation::EngineOptions& options);

}  // namespace stride::planar
