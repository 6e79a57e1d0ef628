#include "calibrate/osim/model.h"

#include <algorithm>

#include "extract/io/data_file.h"
#include "extract/io/error.h"

namespace stride::osim {
namespace {

template <typename Named>
int index_of(const std::vector<Named>& all, std::string_view name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Named& each) { return each.name == name; });
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

}  // namespace

int Model::body(std::string_view wanted) const { return index_of(bodies, wanted); }
int Model::coordinate(std::string_view wanted) const { return index_of(coordinates, wanted); }
int Model::muscle(std::string_view wanted) const { return index_of(muscles, wanted); }

double Model::mass_kg() const {
  double mass = 0;
  for (const Body& body : bodies) mass += body.mass_kg;
  return mass;
}

std::string describe(const Model& model) {
  std::string text = fmt::format(
      "OpenSim model {}: {} bodies, {} coordinates, {} muscles, {} contact spheres\n", model.name,
      model.bodies.size(), model.coordinates.size(), model.muscles.size(), model.spheres.size());
  text += fmt::format("mass {:.4g} kg, gravity {:.6g} m/s²\n\n", model.mass_kg(),
                      -model.gravity_m_s2[1]);
  for (const Coordinate& each : model.coordinates)
    text += fmt::format("  {:<18} default {:8.4f} ({:.3f} to {:.3f}) {}{}\n", each.name,
                        each.default_value, each.range_min, each.range_max,
                        each.rotational ? "rad" : "m", each.locked ? ", locked" : "");
  text += fmt::format("\n  {:<18} {:>9} {:>11} {:>11} {:>13}\n", "muscle", "force [N]", "fibre [m]",
                      "tendon [m]", "path points");
  for (const Muscle& each : model.muscles)
    text += fmt::format("  {:<18} {:9.1f} {:11.4f} {:11.4f} {:13}\n", each.name,
                        each.max_isometric_force_N, each.optimal_fiber_length_m,
                        each.tendon_slack_length_m, each.path.size());
  if (!model.credits.empty()) text += fmt::format("\n{}\n", model.credits);
  return text;
}

std::filesystem::path default_model_file() {
  return data_file("calibrate/models/gait9dof18musc.osim");
}

}  // namespace stride::osim
