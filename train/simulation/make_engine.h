#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "train/simulation/engine/engine.h"

namespace stride::simulation {

/// The engines that there are; the first is the reference.
inline constexpr std::array kEngineNames{"simbody", "planar"};

/// The fast one, which agrees with the reference.
inline constexpr const char* kDefaultEngine = "planar";

/// One of kEngineNames. Throws Error if the engine is not known or cannot represent the model,
/// with the reason and the advice.
std::unique_ptr<Engine> make_engine(std::string_view name, const osim::Model& model,
                                    const EngineOptions& options = {});

}  // namespace stride::simulation
