#pragma once

#include <memory>

#include "train/simulation/engine.h"

namespace stride {

/// The fast engine: the equations of planar_dynamics.h under planar_integrator.h. Throws Error with
/// the reason and the advice `--engine simbody` if it cannot represent the model.
std::unique_ptr<Engine> make_planar_engine(const Model& model, const EngineOptions& options);

}  // namespace stride
