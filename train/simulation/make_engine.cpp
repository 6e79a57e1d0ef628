#include "train/simulation/make_engine.h"

#include "extract/io/error.h"
#include "train/simulation/planar/engine.h"
#include "train/simulation/simbody/simbody_engine.h"

namespace stride::simulation {

std::unique_ptr<Engine> make_engine(std::string_view name, const osim::Model& model,
                                    const EngineOptions& options) {
  if (name == "planar") return planar::make_planar_engine(model, options);
  if (name == "simbody") return simbody::make_simbody_engine(model, options);
  throw Error(fmt::format("engine \"{}\": there is none of this name; engines are {}", name,
                          fmt::join(kEngineNames, ", ")));
}

}  // namespace stride::simulation
