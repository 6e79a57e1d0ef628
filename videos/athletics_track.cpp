#include <cmath>

#include "videos/colour.h"
#include "videos/scenery.h"

namespace stride::videos {
namespace {

class AthleticsTrack final : public Scenery {
 public:
  explicit AthleticsTrack(std::uint64_t seed) : grain_(seed) {}

 protected:
  Colour ground(double x, double z, double) const override {
    if (z < kGrass_m) {
      const double blades = grain_.rough(7 * x, 2.5 * z) + 0.5 * grain_(40 * x, 9 * z);
      return lit(rgb(104, 136, 66), 1 + 0.22 * blades);
    }
    const double crumb = 0.10 * grain_.rough(1.7 * x, 1.7 * z + 9) + 0.09 * grain_(45 * x, 14 * z);
    const Colour tartan = lit(rgb(178, 88, 66), 1 + crumb);
    const double lane = std::abs(std::remainder(z - 0.61, 1.22));
    const double worn = 0.85 + 0.12 * grain_.rough(6 * x, 3 * z);
    // A short mark across the lane every ten metres.
    const double across = std::abs(std::remainder(x, 5.0)) < 0.03 && std::abs(z) < 0.3 ? 1 : 0;
    return mixed(tartan, rgb(236, 232, 224),
                 std::max(worn * (1 - step(lane, 0.025, 0.01)), across));
  }

  double wall_z_m() const override { return -6; }
  double wall_height_m() const override { return 0.92; }

  /// Boards of 3 m with words that nobody can read.
  Colour wall(double x, double y) const override {
    static const Colour kBoards[] = {rgb(38, 84, 140), rgb(226, 226, 220), rgb(190, 44, 48),
                                     rgb(240, 196, 60), rgb(44, 110, 84)};
    static const Colour kLetters[] = {rgb(238, 240, 244), rgb(34, 52, 110), rgb(246, 236, 220),
                                      rgb(40, 36, 34), rgb(236, 240, 214)};
    const double number = std::floor(x / 3), along = x - 3 * number;
    const int kind = static_cast<int>(std::fmod(std::fmod(number * 7 + 3, 5) + 5, 5));
    if (along < 0.05 || y > 0.88) return rgb(92, 96, 100);
    Colour colour = lit(kBoards[kind], 0.94 + 0.08 * grain_.rough(3 * x, 3 * y));
    const double cell = std::floor((along - 0.4) / 0.26), in = (along - 0.4) / 0.26 - cell;
    if (cell >= 0 && cell < 8 && in < 0.78 && y > 0.26 && y < 0.66) {
      const bool upright = in < 0.24;
      const double stroke =
          grain_(31 * cell + 5 * number, std::floor((y - 0.26) / 0.09) * 7.3 + 2.2);
      if (upright || stroke > -0.05) colour = kLetters[kind];
    }
    return colour;
  }

  Colour beyond(double x, double elevation) const override {
    const double crowns =
        0.055 + 0.018 * grain_.rough(0.23 * x, 3.3) + 0.010 * grain_(1.1 * x, 8.1);
    const double high = mixed_sky_start_ + elevation;
    const Colour sky = lit(mixed(rgb(208, 222, 236), rgb(126, 170, 222), std::min(1.0, 7 * high)),
                           1 + 0.05 * grain_.rough(0.12 * x, 40 * elevation));
    const double leaves =
        grain_.rough(1.6 * x, 55 * elevation) + 0.4 * grain_(6 * x, 210 * elevation);
    const Colour tree =
        lit(mixed(rgb(48, 74, 40), rgb(92, 118, 58), 8 * elevation), 1 + 0.45 * leaves);
    return mixed(tree, sky, step(elevation, crowns + 0.003 * leaves, 0.004));
  }

 private:
  static constexpr double kGrass_m = -3.05;
  static constexpr double mixed_sky_start_ = -0.03;
  Texture grain_;
};

}  // namespace

std::unique_ptr<Scenery> track_scene(std::uint64_t seed) {
  return std::make_unique<AthleticsTrack>(seed);
}

}  // namespace stride::videos
