#include "shaping/pose.h"

#include <algorithm>

namespace stride {

Pose Pose::mirrored() const {
  Pose mirrored;
  for (const ComparedPart& each : kPoseParts)
    std::ranges::copy(numbers(each.mirrored), mirrored.numbers(each.part).begin());
  return mirrored;
}

}  // namespace stride
