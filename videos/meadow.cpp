#include <cmath>

#include "videos/colour.h"
#include "videos/scenery.h"

namespace stride::videos {
namespace {

/// Flat colours and lines, as painted on film.
class Meadow final : public Scenery {
 protected:
  Colour ground(double x, double z, double) const override {
    if (z < -1.3 || z > 1.4) {
      const double tuft = std::abs(std::remainder(x + 0.7 * std::floor(z / 0.5), 1.3));
      const double in = z / 0.5 - std::floor(z / 0.5);
      return tuft < 0.12 * (1 - in) && in < 0.6 ? rgb(64, 150, 60) : rgb(120, 200, 84);
    }
    if (z < -1.22 || z > 1.32) return rgb(96, 70, 44);
    const double pebble = std::hypot(std::remainder(x + 0.31 * std::floor(z / 0.45), 0.9),
                                     std::remainder(z, 0.45) * 1.4);
    if (pebble < 0.045) return rgb(196, 158, 106);
    return rgb(226, 190, 134);
  }

  double wall_z_m() const override { return -4; }
  double wall_height_m() const override { return 0.9; }

  /// A fence of boards with pointed tops, through which the meadow is seen.
  Colour wall(double x, double y) const override {
    const double in = std::remainder(x, 0.55);
    const double top = 0.82 - 0.6 * std::max(0.0, std::abs(in) - 0.06);
    if (std::abs(in) < 0.155 && y < top) {
      if (std::abs(in) > 0.135 || y > top - 0.03) return rgb(70, 60, 56);
      return in < -0.06 ? rgb(216, 208, 196) : rgb(246, 242, 232);
    }
    if (std::abs(y - 0.28) < 0.06 || std::abs(y - 0.60) < 0.06) return rgb(206, 198, 186);
    return rgb(134, 206, 100);
  }

  Colour beyond(double x, double tangent) const override {
    const double elevation = 2.4 * tangent;
    const double far = 0.060 + 0.022 * std::sin(0.16 * x) + 0.008 * std::sin(0.41 * x + 1);
    const double near = 0.022 + 0.014 * std::sin(0.27 * x + 2);
    if (elevation < near) return elevation > near - 0.002 ? rgb(70, 130, 70) : rgb(134, 206, 100);
    // Round trees on the near hills.
    const double in = std::remainder(x, 7.3);
    const double r = std::hypot(2.4 * in / 45, elevation - near - 0.022);
    if (r < 0.017)
      return r > 0.0155 ? rgb(40, 84, 44) : in < -0.2 ? rgb(70, 150, 72) : rgb(92, 176, 84);
    if (std::abs(in) < 0.12 && elevation < near + 0.010) return rgb(112, 78, 48);
    if (elevation < far) return elevation > far - 0.002 ? rgb(90, 150, 110) : rgb(164, 216, 150);
    // Clouds of circles.
    const double cx = std::remainder(x - 5, 21),
                 height = elevation - 0.125 - 0.01 * std::sin(std::floor((x - 5) / 21 + 0.5));
    for (const double offset : {-0.45, 0.0, 0.5})
      if (std::hypot(2.4 * (cx - offset) / 45, height - (offset == 0 ? 0.006 : 0)) < 0.019)
        return rgb(252, 252, 255);
    return mixed(rgb(190, 228, 250), rgb(110, 186, 240), std::min(1.0, 5.5 * elevation));
  }
};

}  // namespace

std::unique_ptr<Scenery> meadow_scene() { return std::make_unique<Meadow>(); }

}  // namespace stride::videos
