#pragma once

#include <memory>
#include <vector>

#include "videos/noise.h"
#include "videos/patch.h"
#include "videos/skeleton.h"

namespace stride::videos {

/// What a character looks like: a skeleton dressed in patches, in the order of painting for a
/// camera on that side of it.
class Costume {
 public:
  virtual ~Costume() = default;
  virtual std::vector<Patch> dress(const Skeleton& skeleton, const Proportions& proportions,
                                   bool from_left) const = 0;
  virtual double outline_m() const { return 0; }
};

std::unique_ptr<Costume> human_costume(std::uint64_t seed);

/// A disc at every body part and nothing else, to find the truth in a picture.
std::unique_ptr<Costume> marker_costume();
inline constexpr double kMarkerRadius_m = 0.03;
Colour marker_colour(BodyPart part);

}  // namespace stride::videos
