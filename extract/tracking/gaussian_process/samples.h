#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "extract/skeleton/body_part.h"
#include "extract/tracking/gaussian_process/gait_process.h"

namespace stride::gaussian_process {

/// One or two body parts that are modelled together: a joint of both legs, or a part of the trunk.
struct Group {
  BodyPart right, left;  // the same for the trunk
  bool paired() const { return right != left; }
};

inline constexpr Group kPelvis{BodyPart::pelvis, BodyPart::pelvis};
inline constexpr auto kLegGroups = [] {
  std::array<Group, kLegPairs.size()> groups{};
  for (std::size_t i = 0; i < groups.size(); ++i)
    groups[i] = {kLegPairs[i].right, kLegPairs[i].left};
  return groups;
}();
inline constexpr Group kHead{BodyPart::head, BodyPart::head};

/// An observation of a group.
struct Sample : Observation {
  int left = 0;  // or 1
};

/// The samples of a group minus their mean, and the scale of the motion.
struct GroupData {
  Group group;
  std::vector<Sample> samples;
  Eigen::Vector2d mean_px, scale_px;  // scale: standard deviation of the periodic motion
  Eigen::Vector2d drift;              // trunk: variance of its path, in units of the scale
};

GroupData centred(Group group, std::vector<Sample> samples, double size_px);

/// Collects the observations of a group. Times are relative to the origin.
std::vector<Sample> samples_of(Group group, const Observations& observations, double origin_s);

}  // namespace stride::gaussian_process
