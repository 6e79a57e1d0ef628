#pragma once

#include <memory>
#include <vector>

#include "videos/patch.h"
#include "videos/skeleton.h"
#include "videos/texture.h"

namespace stride::videos {

/// The appearance of a character: patches on a skeleton, in painting order for a camera on that
/// side.
class Costume {
 public:
  virtual ~Costume() = default;
  virtual std::vector<Patch> dress(const Skeleton& skeleton, const Proportions& proportions,
                                   bool from_left) const = 0;
};

/// A runner in shorts and shirt.
struct HumanLook {
  Colour skin = rgb(214, 162, 128), hair = rgb(62, 40, 28);
  Colour shirt = rgb(226, 92, 38), shirt_band = rgb(245, 238, 225);
  Colour shorts = rgb(38, 52, 96), stripe = rgb(222, 226, 236);
  Colour sock = rgb(232, 232, 228), shoe = rgb(60, 190, 90);
  Colour sole = rgb(240, 240, 236), lace = rgb(24, 26, 30);
  bool ponytail = false;
};
std::unique_ptr<Costume> human_costume(std::uint64_t seed, const HumanLook& look = {});

/// An armoured hero, plates that shine.
std::unique_ptr<Costume> game_costume(std::uint64_t seed);

/// A drawn boy: flat colours, outlines, identical legs.
std::unique_ptr<Costume> cartoon_costume();

/// Only a disc at every body part, to measure the truth in a picture.
std::unique_ptr<Costume> marker_costume();
inline constexpr double kMarkerRadius_m = 0.03;
Colour marker_colour(BodyPart part);

}  // namespace stride::videos
