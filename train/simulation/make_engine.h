#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "train/simulation/engine/engine.h"

namespace stride::simulation {

/// The names of the engines; the first is the reference.
inline constexpr std::array kEngineNames{"simbody", "planar"};

/// The default engine, the fast one.
inline constexpr const char* kDefaultEngine = "planar";

/// Makes an engine of kEngineNames. Throws Error if the name is unknown or the engine cannot
/// represent the model, with the reason and the cure.
std::unique_ptr<Engine> make_engine(std::string_view name, const osim::Model& model,
                                    const EngineOptions& options = {});

}  // namespace stride::simulation
