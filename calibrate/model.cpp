#include "calibrate/model.h"

#include <algorithm>

#include "extract/error.h"

namespace stride {
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

std::filesystem::path default_model_file() {
  return std::filesystem::path(STRIDE_MODELS_FOLDER) / "gait9dof18musc.osim";
}

}  // namespace stride
