#include "extract/tracking/gaussian_process/samples.h"

#include <algorithm>

namespace stride::gaussian_process {

using Eigen::Vector2d;

/// Scale of the trunk's motion about its path, as a fraction of the leg. A scale from the clicks
/// would let a camera's drift pass for periodic motion wherever the clicks' spacing allows it.
constexpr double kTrunkSway = 0.015, kTrunkBob = 0.08, kDrift = 1.0;

GroupData centred(Group group, std::vector<Sample> samples, double size_px) {
  GroupData data{group, std::move(samples), Vector2d::Zero(), Vector2d::Zero(), Vector2d::Zero()};
  const auto places =
      std::ranges::count_if(data.samples, [](const Sample& s) { return !s.is_displacement(); });
  const double n = std::max(1.0, static_cast<double>(places));
  for (const Sample& s : data.samples)
    if (!s.is_displacement()) data.mean_px += s.p_px / n;
  for (Sample& s : data.samples) {
    if (s.is_displacement()) continue;
    s.p_px -= data.mean_px;
    data.scale_px += s.p_px.cwiseAbs2() / n;
  }
  if (group.paired()) {
    data.scale_px = data.scale_px.cwiseSqrt().cwiseMax(1);
  } else {
    data.scale_px = size_px * Vector2d(kTrunkSway, kTrunkBob);
    data.drift = (size_px * kDrift / data.scale_px.array()).square();
  }
  return data;
}

std::vector<Sample> samples_of(Group group, const Observations& observations, double origin_s) {
  std::vector<Sample> samples;
  const auto add = [&](BodyPart part, int left) {
    for (Observation o : observations[index(part)]) {
      o.time_s -= origin_s;
      o.since_s -= origin_s;
      samples.push_back({o, left});
    }
  };
  add(group.right, 0);
  if (group.paired()) add(group.left, 1);
  return samples;
}

}  // namespace stride::gaussian_process
