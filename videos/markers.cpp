#include "videos/costume.h"
#include "videos/scenery.h"

namespace stride::videos {
namespace {

class Markers final : public Costume {
 public:
  std::vector<Patch> dress(const Skeleton& skeleton, const Proportions&, bool) const override {
    std::vector<Patch> patches;
    for (const BodyPart part : kAskedParts) {
      Patch& disc = patches.emplace_back();
      // A round end before and after almost nothing.
      constexpr double kLength = 1e-6;
      disc.origin = skeleton[part].head<2>();
      disc.axis = {1, 0};
      disc.front = {0, 1};
      disc.z_m = skeleton[part].z();
      disc.stations = {{0, kMarkerRadius_m, kMarkerRadius_m},
                       {kLength, kMarkerRadius_m, kMarkerRadius_m}};
      disc.roundness = disc.end_roundness = 0;
      disc.colour = [part](double, double) { return marker_colour(part); };
    }
    return patches;
  }
};

class Dark final : public Scenery {
  Colour ground(double, double, double) const override { return {}; }
  double wall_z_m() const override { return -6; }
  double wall_height_m() const override { return 1; }
  Colour wall(double, double) const override { return {}; }
  Colour beyond(double, double) const override { return {}; }
};

}  // namespace

Colour marker_colour(BodyPart part) {
  const int number = index(part);
  return {0.9F, number % 2 == 0 ? 0.9F : 0.45F, 0.08F * static_cast<float>(number)};
}

std::unique_ptr<Costume> marker_costume() { return std::make_unique<Markers>(); }
std::unique_ptr<Scenery> dark_scene() { return std::make_unique<Dark>(); }

}  // namespace stride::videos
