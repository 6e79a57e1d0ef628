#include <cmath>

#include "videos/colour.h"
#include "videos/scenery.h"

namespace stride::videos {
namespace {

class Arena final : public Scenery {
 public:
  explicit Arena(std::uint64_t seed) : grain_(seed) {}

 protected:
  Colour ground(double x, double z, double) const override {
    const double i = std::floor(x / 1.5), j = std::floor(z / 1.2);
    const double in_x = x / 1.5 - i, in_z = z / 1.2 - j;
    const double tone = grain_(i * 3.3 + 0.5, j * 5.1 + 0.5);
    const double joint = std::min({in_x * 1.5, (1 - in_x) * 1.5, in_z * 1.2, (1 - in_z) * 1.2});
    if (std::abs(z + 1.2) < 0.05) return lit(rgb(255, 140, 50), 0.9 + 0.1 * std::sin(3 * x));
    const double scratch = 0.16 * grain_.rough(3 * x, 14 * z) + 0.10 * grain_(30 * x, 30 * z);
    const Colour metal = mixed(rgb(70, 76, 92), rgb(104, 108, 122), 0.5 + 0.5 * tone);
    return lit(metal, (1 + scratch) * (joint < 0.02 ? 0.45 : joint < 0.035 ? 1.3 : 1));
  }

  double wall_z_m() const override { return -5; }
  double wall_height_m() const override { return 0.85; }

  Colour wall(double x, double y) const override {
    const double in = x - 2.5 * std::floor(x / 2.5);
    if (y > 0.78) return rgb(60, 66, 80);
    if (in < 0.25) return lit(rgb(60, 64, 78), 0.8 + 0.5 * y);
    if (y > 0.5 && y < 0.58 && in > 0.5 && in < 2.2)
      return lit(rgb(80, 226, 255), in > 1.6 ? 0.5 : 1);
    return lit(rgb(112, 92, 84), 0.7 + 0.3 * y + 0.14 * grain_.rough(5 * x, 5 * y));
  }

  Colour beyond(double x, double elevation) const override {
    // Rocks before a red sky with a planet.
    const double ridge = 0.03 + 0.03 * grain_.rough(0.16 * x, 2.2) + 0.006 * grain_(1.3 * x, 4.4);
    if (elevation < ridge)
      return lit(mixed(rgb(96, 52, 54), rgb(150, 84, 66), 8 * elevation),
                 1 + 0.25 * grain_.rough(0.9 * x, 60 * elevation));
    const double dx = (std::remainder(x, 26) - 6) / 45, dy = elevation - 0.085;
    const double r = std::hypot(dx, dy) / 0.035;
    const Colour sky = mixed(rgb(226, 132, 92), rgb(56, 42, 88), std::min(1.0, 9 * elevation));
    if (r < 1) {
      const double bands = 0.08 * std::sin(160 * dy + 3 * grain_(30 * dx, 30 * dy));
      return lit(
          rgb(228, 200, 160),
          (0.55 + 0.45 * std::max(0.0, 0.4 - dx / 0.035 * 0.7 + dy / 0.035 * 0.4)) * (1 + bands));
    }
    return lit(sky, 1 + 0.07 * grain_.rough(0.2 * x, 50 * elevation));
  }

 private:
  Texture grain_;
};

}  // namespace

std::unique_ptr<Scenery> arena_scene(std::uint64_t seed) { return std::make_unique<Arena>(seed); }

}  // namespace stride::videos
