#include <cmath>

#include "videos/colour.h"
#include "videos/scenery.h"

namespace stride::videos {
namespace {

class Street final : public Scenery {
 public:
  explicit Street(std::uint64_t seed) : grain_(seed) {}

 protected:
  Colour ground(double x, double z, double) const override {
    const double stone = 0.10 * grain_.rough(2.3 * x, 2.3 * z) + 0.10 * grain_(50 * x, 15 * z);
    if (z > 1.15) {  // the road, and the kerb before it
      if (z < 1.32) return lit(rgb(188, 186, 180), 1 + stone);
      return lit(rgb(92, 94, 98), 1 + 1.5 * stone);
    }
    // Slabs of 60 × 40 cm, every second row set off.
    const double row = std::floor(z / 0.4), along = x / 0.6 + 0.5 * std::fmod(std::abs(row), 2);
    const double joint = std::min(std::abs(z / 0.4 - std::round(z / 0.4)) * 0.4,
                                  std::abs(along - std::round(along)) * 0.6);
    const double shade = 0.12 * grain_(std::floor(along) * 5.3 + 0.5, row * 3.7 + 0.5);
    return lit(rgb(172, 164, 152), (1 + stone + shade) * (joint < 0.008 ? 0.66 : 1));
  }

  double wall_z_m() const override { return -1.6; }
  double wall_height_m() const override { return 2.15; }

  Colour wall(double x, double y) const override {
    if (y > 2.07) return lit(rgb(170, 166, 160), 1 + 0.1 * grain_.rough(8 * x, 9 * y));
    if (y < 0.25) return lit(rgb(136, 132, 128), 1 + 0.12 * grain_.rough(6 * x, 12 * y));
    // A window with a blind every 3.4 m.
    const double in = x - 3.4 * std::floor(x / 3.4);
    if (in > 1.1 && in < 2.3 && y > 0.95 && y < 1.85) {
      const double rim = std::min({in - 1.1, 2.3 - in, y - 0.95, 1.85 - y});
      if (rim < 0.06 || std::abs(in - 1.7) < 0.025) return rgb(232, 230, 222);
      const double slat = std::fmod(y, 0.06) < 0.008 ? 0.75 : 1;
      return lit(mixed(rgb(96, 122, 140), rgb(168, 186, 196), y - 0.9),
                 slat + 0.08 * grain_(3 * x, 4 * y));
    }
    const double row = std::floor(y / 0.075), along = x / 0.25 + 0.5 * std::fmod(row, 2);
    const double joint = std::min(std::abs(y / 0.075 - std::round(y / 0.075)) * 0.075,
                                  std::abs(along - std::round(along)) * 0.25);
    if (joint < 0.006) return lit(rgb(186, 172, 156), 1 + 0.1 * grain_(40 * x, 40 * y));
    const double tone = grain_(std::floor(along) * 7.1 + 0.5, row * 5.9 + 0.5);
    return lit(mixed(rgb(150, 84, 64), rgb(178, 112, 82), 0.5 + 0.5 * tone),
               1 + 0.16 * grain_.rough(24 * x, 24 * y));
  }

  Colour beyond(double x, double elevation) const override {
    return lit(rgb(196, 208, 220), 1 + 0.05 * grain_.rough(0.2 * x, 30 * elevation));
  }

 private:
  Texture grain_;
};

}  // namespace

std::unique_ptr<Scenery> street_scene(std::uint64_t seed) { return std::make_unique<Street>(seed); }

}  // namespace stride::videos
