#include <cmath>

#include "videos/colour.h"
#include "videos/limb.h"
#include "videos/scenery.h"

namespace stride::videos {
namespace {

constexpr double kBack_m = -1.05, kFront_m = 0.95, kHalf_m = 0.36;  // of the treadmill

class Gym final : public Scenery {
 public:
  explicit Gym(std::uint64_t seed) : grain_(seed) {}

  std::vector<Patch> behind(bool from_left) const override {
    return {post(from_left ? kHalf_m : -kHalf_m)};
  }

  std::vector<Patch> before(bool from_left) const override {
    const double z = from_left ? -kHalf_m : kHalf_m;
    // The side of the frame hides nothing: it is below the belt.
    Patch frame;
    frame.origin = {kBack_m, -0.10};
    frame.axis = {1, 0};
    frame.front = {0, 1};
    frame.z_m = z;
    frame.stations = {{0, 0.10, 0.08}, {kFront_m - kBack_m, 0.10, 0.08}};
    frame.round_start = frame.round_end = false;
    frame.roundness = 0.4;
    frame.gloss = 0.2;
    frame.colour = [this](double s, double across) {
      const Colour colour = across > 0.55 ? rgb(70, 74, 82) : rgb(186, 190, 196);
      return lit(std::abs(s - 1) < 0.3 && std::abs(across) < 0.25 ? rgb(196, 48, 44) : colour,
                 1 + 0.05 * grain_.rough(9 * s, 3 * across));
    };
    return {frame, post(z)};
  }

 protected:
  Colour ground(double x, double z, double belt_m) const override {
    if (x > kBack_m && x < kFront_m && std::abs(z) < kHalf_m) {
      if (std::abs(z) > 0.27) return lit(rgb(58, 60, 66), std::fmod(x + 9, 0.04) < 0.02 ? 1 : 0.8);
      // The belt runs backward: what it carries was further forward.
      const double on = x + belt_m;
      const double rubber = 0.20 * grain_.rough(9 * on, 9 * z) + 0.25 * grain_(70 * on, 25 * z);
      const bool mark = std::abs(std::remainder(on, 1.5)) < 0.03 ||
                        (std::abs(std::remainder(on, 0.5)) < 0.05 && std::abs(z) > 0.20);
      return mark ? rgb(200, 200, 196) : lit(rgb(46, 46, 50), 1 + rubber);
    }
    const double fleck = grain_(60 * x, 60 * z);
    const Colour mat = fleck > 0.72 ? rgb(110, 140, 190) : rgb(84, 86, 92);
    const double joint =
        std::min(std::abs(std::remainder(x, 1.0)), std::abs(std::remainder(z, 1.0)));
    return lit(mat, (1 + 0.08 * grain_.rough(3 * x, 3 * z)) * (joint < 0.008 ? 0.7 : 1));
  }

  double wall_z_m() const override { return -2.6; }
  double wall_height_m() const override { return 2.9; }

  Colour wall(double x, double y) const override {
    const double plaster = 1 + 0.05 * grain_.rough(3 * x, 3 * y) + 0.03 * grain_(30 * x, 30 * y);
    if (y < 0.12) return lit(rgb(70, 66, 64), plaster);
    if (y < 0.95) return lit(rgb(92, 128, 146), plaster * (std::abs(y - 0.92) < 0.03 ? 0.7 : 1));
    // Posters and a clock.
    const double in = x + 4.4 - 2.2 * std::floor((x + 4.4) / 2.2);
    const double number = std::floor((x + 4.4) / 2.2);
    if (in > 0.5 && in < 1.4 && y > 1.25 && y < 2.3) {
      const double rim = std::min({in - 0.5, 1.4 - in, y - 1.25, 2.3 - y});
      if (rim < 0.04) return rgb(40, 40, 44);
      const double shape = grain_.rough(3 * in + 11 * number, 3 * y);
      return shape > 0.1     ? rgb(226, 178, 62)
             : shape > -0.15 ? rgb(196, 70, 54)
                             : rgb(240, 236, 226);
    }
    return lit(rgb(214, 208, 196), plaster);
  }

  Colour beyond(double, double) const override { return rgb(236, 236, 232); }

 private:
  Patch post(double z) const {
    Patch patch;
    patch.origin = {kFront_m - 0.12, 0};
    patch.axis = Eigen::Vector2d(-0.05, 1).normalized();
    patch.front = {1, 0};
    patch.z_m = z;
    patch.stations = {{0, 0.035, 0.035},
                      {1.02, 0.03, 0.03},
                      {1.06, 0.05, 0.16},
                      {1.16, 0.03, 0.20},
                      {1.22, 0.02, 0.06}};
    patch.gloss = 0.2;
    patch.colour = [](double s, double) { return s > 1.04 ? rgb(36, 38, 44) : rgb(150, 154, 162); };
    return patch;
  }

  Texture grain_;
};

}  // namespace

std::unique_ptr<Scenery> gym_scene(std::uint64_t seed) { return std::make_unique<Gym>(seed); }

}  // namespace stride::videos
