#include "extract/tracking/leg_identity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "extract/io/error.h"
#include "extract/io/statistics.h"
#include "extract/tracking/stride_fold.h"

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr const auto& kJoints = kLegPairs;
constexpr std::size_t kKnee = 0, kAnkle = 1;
static_assert(kJoints[kKnee].right == BodyPart::knee_r &&
              kJoints[kAnkle].right == BodyPart::ankle_r);

constexpr int kMemory = 3;            // earlier frames from which a joint's path is extrapolated
constexpr double kChangeCost = 2;     // of a swap that begins or ends
constexpr double kSwapCost = 0.15;    // of every swapped frame: most labels are right
constexpr double kNearLegCost = 0.3;  // of the far leg being seen better than the near one
constexpr double kLeastEvidence = 3;  // for a swap to be applied
constexpr int kRounds = 3;

/// The joints of the legs relative to the pelvis, by frame.
struct Legs {
  std::vector<int> frames;
  std::vector<double> times_s;
  std::vector<std::vector<JointPair>> joints;  // [joint][frame]
};

std::vector<Vector2d> pelvis_path(const Trajectory& points) {
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < points.frames.size(); ++i)
    if (points.frames[i][BodyPart::pelvis].present()) seen.push_back(i);
  require(!seen.empty(),
          "{}: the pelvis is on no frame: expected the middle of the hips, or both hips; legs "
          "cannot be told apart without it",
          points.video);
  std::vector<Vector2d> path(points.frames.size());
  std::size_t after = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    while (after < seen.size() && seen[after] < i) ++after;
    const std::size_t b = seen[std::min(after, seen.size() - 1)],
                      a = after > 0 ? seen[after - 1] : b;
    const auto at = [&](std::size_t k) { return points.frames[k][BodyPart::pelvis].p_px; };
    const double span = points.frames[b].time_s - points.frames[a].time_s;
    const double share =
        span > 0 ? std::clamp((points.frames[i].time_s - points.frames[a].time_s) / span, 0.0, 1.0)
                 : 0;
    path[i] = (1 - share) * at(a) + share * at(b);
  }
  return path;
}

Legs legs_of(const Trajectory& points) {
  Legs legs;
  const std::vector<Vector2d> pelvis = pelvis_path(points);
  legs.joints.resize(kJoints.size());
  for (std::size_t i = 0; i < points.frames.size(); ++i) {
    legs.frames.push_back(points.frames[i].frame);
    legs.times_s.push_back(points.frames[i].time_s);
    for (std::size_t j = 0; j < kJoints.size(); ++j) {
      JointPair& pair = legs.joints[j].emplace_back();
      for (int side = 0; side < 2; ++side) {
        const Point& point = points.frames[i][kJoints[j][side]];
        pair.p_px[side] = point.p_px - pelvis[i];
        pair.weight[side] = std::clamp(point.confidence, 0.2, 1.0);
      }
    }
  }
  return legs;
}

double cauchy(double distance, double spread) {
  return std::log1p(distance * distance / (spread * spread));
}

/// Frames on which the feet are on the wrong knees, by the lengths of the shanks.
std::vector<bool> crossed_feet(const Legs& legs) {
  const auto& knees = legs.joints[kKnee];
  const auto& ankles = legs.joints[kAnkle];
  const auto length = [&](std::size_t i, int knee, int ankle) {
    return (knees[i].p_px[knee] - ankles[i].p_px[ankle]).norm();
  };
  std::vector<double> lengths;
  for (std::size_t i = 0; i < knees.size(); ++i)
    for (int side = 0; side < 2; ++side)
      if (const double l = length(i, side, side); std::isfinite(l)) lengths.push_back(l);
  const double usual = median(lengths);
  std::vector<bool> crossed(knees.size());
  for (std::size_t i = 0; i < knees.size(); ++i) {
    double as_is = 0, other = 0;
    for (int side = 0; side < 2; ++side) {
      as_is = std::max(as_is, std::abs(length(i, side, side) / usual - 1));
      other = std::max(other, std::abs(length(i, side, 1 - side) / usual - 1));
    }
    crossed[i] = as_is > 0.35 && other < 0.15;  // false with NaN: all four must be seen
  }
  return crossed;
}

/// The joint's position, swapped or not.
const Vector2d& place(const Legs& legs, std::size_t joint, std::size_t i, int side, bool swapped) {
  return legs.joints[joint][i].p_px[swapped ? 1 - side : side];
}

/// Distance of a joint from the extrapolation of its path, given the labelling of the last frames
/// (bit k: swapped k frames ago), and how many frames that looks back. Nothing if it was not seen
/// recently.
struct Jump {
  double distance_px;
  double spread_factor;  // the less that is known of the path, the wider
};
std::optional<Jump> jump(const Legs& legs, std::size_t joint, std::size_t i, int side,
                         unsigned naming) {
  const auto at = [&](std::size_t back) -> const Vector2d& {
    return place(legs, joint, i - back, side, naming >> back & 1);
  };
  const Vector2d& now = at(0);
  if (!now.allFinite()) return std::nullopt;
  std::array<std::size_t, 2> seen{};
  int count = 0;
  for (std::size_t back = 1; back <= kMemory && back <= i && count < 2; ++back)
    if (legs.frames[i] - legs.frames[i - back] <= kMemory && at(back).allFinite())
      seen[static_cast<std::size_t>(count++)] = back;
  if (count == 0) return std::nullopt;
  const auto ago_s = [&](std::size_t back) { return legs.times_s[i] - legs.times_s[i - back]; };
  if (count == 1) return Jump{(now - at(seen[0])).norm(), 4.0 * static_cast<double>(seen[0])};
  const double ahead = ago_s(seen[0]) / (ago_s(seen[1]) - ago_s(seen[0]));
  const Vector2d expected = at(seen[0]) + ahead * (at(seen[0]) - at(seen[1]));
  return Jump{(now - expected).norm(), static_cast<double>(seen[0]) * (0.5 + 0.5 * ahead)};
}

/// Typical extrapolation error of each joint without swaps.
std::vector<double> usual_jumps(const Legs& legs, const std::vector<bool>& swapped) {
  std::vector<double> spreads;
  for (std::size_t joint = 0; joint < kJoints.size(); ++joint) {
    std::vector<double> jumps;
    for (std::size_t i = 2; i < legs.frames.size(); ++i) {
      unsigned naming = 0;
      for (std::size_t back = 0; back <= std::min<std::size_t>(kMemory, i); ++back)
        naming |= static_cast<unsigned>(swapped[i - back]) << back;
      for (int side = 0; side < 2; ++side)
        if (const auto j = jump(legs, joint, i, side, naming); j && j->spread_factor == 1)
          jumps.push_back(j->distance_px);
    }
    spreads.push_back(jumps.empty() ? 1 : std::max(1.5 * median(jumps), 1.0));
  }
  return spreads;
}

/// The costs of a labelling, frame by frame.
struct Costs {
  const Legs& legs;
  std::vector<double> jump_px;
  std::optional<StrideFold> fold;
  int near_side = -1;  // 0 right, 1 left, −1 not known
  const std::set<int>& clicked;

  double path(std::size_t i, unsigned naming) const {
    double sum = 0;
    for (std::size_t joint = 0; joint < kJoints.size(); ++joint)
      for (int side = 0; side < 2; ++side)
        if (const auto j = jump(legs, joint, i, side, naming))
          sum += legs.joints[joint][i].weight[naming & 1 ? 1 - side : side] *
                 cauchy(j->distance_px, jump_px[joint] * j->spread_factor);
    return sum;
  }

  double phase(std::size_t i, bool swapped) const {
    if (!fold) return 0;
    double sum = 0;
    for (std::size_t joint = 0; joint < kJoints.size(); ++joint)
      for (int side = 0; side < 2; ++side) {
        const Vector2d& p = place(legs, joint, i, side, swapped);
        if (p.allFinite())
          sum += legs.joints[joint][i].weight[swapped ? 1 - side : side] *
                 cauchy((p - fold->place(joint, side, legs.times_s[i])).norm(),
                        2 * fold->spread_px[joint]);
      }
    return sum;
  }

  double habit(std::size_t i, bool swapped) const {
    if (clicked.contains(legs.frames[i]))
      return swapped ? std::numeric_limits<double>::infinity() : 0;
    double cost = swapped ? kSwapCost : 0;
    if (near_side >= 0) {
      const auto& ankle = legs.joints[kAnkle][i];
      const int called_near = swapped ? 1 - near_side : near_side;
      cost +=
          kNearLegCost * std::max(0.0, ankle.weight[1 - called_near] - ankle.weight[called_near]);
    }
    return cost;
  }
};

/// The labelling of minimal cost. The state is the labelling of the last frames, bit 0 the newest.
std::vector<bool> cheapest_naming(const Costs& costs) {
  constexpr unsigned kStates = 1u << kMemory;
  const std::size_t n = costs.legs.frames.size();
  std::vector<std::array<unsigned, kStates>> from(n);
  std::array<double, kStates> best;
  best.fill(std::numeric_limits<double>::infinity());
  best[0] = 0;
  best[kStates - 1] = 0;  // as if it had always been so
  for (std::size_t i = 0; i < n; ++i) {
    std::array<double, kStates> next;
    next.fill(std::numeric_limits<double>::infinity());
    for (unsigned state = 0; state < kStates; ++state) {
      if (!std::isfinite(best[state])) continue;
      for (unsigned swapped = 0; swapped < 2; ++swapped) {
        const unsigned naming = state << 1 | swapped;
        const double cost = best[state] + costs.path(i, naming) + costs.phase(i, swapped != 0) +
                            costs.habit(i, swapped != 0) +
                            ((state & 1) != swapped ? kChangeCost : 0);
        const unsigned newest = naming & (kStates - 1);
        if (cost < next[newest]) {
          next[newest] = cost;
          from[i][newest] = state;
        }
      }
    }
    best = next;
  }
  std::vector<bool> swapped(n);
  auto state = static_cast<unsigned>(std::ranges::min_element(best) - best.begin());
  for (std::size_t i = n; i-- > 0;) {
    swapped[i] = state & 1;
    state = from[i][state];
  }
  return swapped;
}

double total(const Costs& costs, const std::vector<bool>& swapped, std::size_t first,
             std::size_t end) {
  double sum = 0;
  for (std::size_t i = first; i < end; ++i) {
    unsigned naming = 0;
    for (std::size_t back = 0; back <= std::min<std::size_t>(kMemory, i); ++back)
      naming |= static_cast<unsigned>(swapped[i - back]) << back;
    sum += costs.path(i, naming);
  }
  return sum;
}

/// An interval of swapped frames with its evidence.
LegSwap explained(const Costs& costs, const std::vector<bool>& swapped, std::size_t first,
                  std::size_t last) {
  std::vector<bool> kept = swapped;
  for (std::size_t i = first; i <= last; ++i) kept[i] = false;
  const std::size_t end = std::min(last + kMemory + 1, swapped.size());
  const double path = total(costs, kept, first, end) - total(costs, swapped, first, end);
  double phase = 0;
  for (std::size_t i = first; i <= last; ++i) phase += costs.phase(i, false) - costs.phase(i, true);
  LegSwap swap;
  swap.first_frame = costs.legs.frames[first];
  swap.last_frame = costs.legs.frames[last];
  swap.evidence = path + phase;
  swap.why = fmt::format(
      "the joints' paths speak for it by {:.1f}, the phase of the stride by {:.1f}", path, phase);
  return swap;
}

/// Right and left joints with the labels found.
Legs renamed(Legs legs, const std::vector<bool>& swapped) {
  for (auto& joint : legs.joints)
    for (std::size_t i = 0; i < swapped.size(); ++i)
      if (swapped[i]) {
        std::swap(joint[i].p_px[0], joint[i].p_px[1]);
        std::swap(joint[i].weight[0], joint[i].weight[1]);
      }
  return legs;
}

/// 0 right, 1 left, −1 not known.
int near_side(std::optional<Facing> direction) {
  return direction ? static_cast<int>(*direction) : -1;
}

}  // namespace

void swap_legs(TrajectoryFrame& frame) {
  for (const auto& [right, left] : kJoints) std::swap(frame[right], frame[left]);
}

LegIdentity repair_legs(const Trajectory& points, const LegIdentityOptions& options) {
  LegIdentity result;
  result.repaired = points;
  if (points.frames.empty()) return result;
  Legs legs = legs_of(points);
  const std::vector<bool> crossed = crossed_feet(legs);
  for (std::size_t i = 0; i < crossed.size(); ++i) {
    if (!crossed[i] || options.clicked_frames.contains(legs.frames[i])) continue;
    for (std::size_t joint = 0; joint < kJoints.size(); ++joint) {
      if (!hangs_from(kJoints[joint].right, BodyPart::ankle_r)) continue;
      std::swap(result.repaired.frames[i][kJoints[joint][0]],
                result.repaired.frames[i][kJoints[joint][1]]);
      std::swap(legs.joints[joint][i].p_px[0], legs.joints[joint][i].p_px[1]);
      std::swap(legs.joints[joint][i].weight[0], legs.joints[joint][i].weight[1]);
    }
    result.swaps.push_back({legs.frames[i], legs.frames[i], 1,
                            "only the feet: each hung on the other leg's knee by the length of "
                            "the shank"});
  }

  std::vector<bool> swapped(legs.frames.size());
  Costs costs{
      legs, usual_jumps(legs, swapped), {}, near_side(points.direction), options.clicked_frames};
  costs.fold = fold_stride(legs.joints, legs.times_s);  // most labels are right
  // Between frames that are far apart, paths carry no information.
  const int span = legs.frames.back() - legs.frames.front();
  if (!costs.fold && span >= 2 * (static_cast<int>(legs.frames.size()) - 1)) return result;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<bool> before = swapped;
    swapped = cheapest_naming(costs);
    if (round > 0 && swapped == before) break;
    costs.fold = fold_stride(renamed(legs, swapped).joints, legs.times_s);
    costs.jump_px = usual_jumps(legs, swapped);
  }
  if (costs.fold) result.period_s = costs.fold->period_s;
  for (std::size_t i = 0; i < swapped.size(); ++i) {
    if (!swapped[i]) continue;
    std::size_t last = i;
    while (last + 1 < swapped.size() && swapped[last + 1]) ++last;
    const LegSwap swap = explained(costs, swapped, i, last);
    if (swap.evidence >= kLeastEvidence) {
      result.swaps.push_back(swap);
      for (std::size_t k = i; k <= last; ++k) swap_legs(result.repaired.frames[k]);
    }
    i = last;
  }
  std::ranges::sort(result.swaps, {}, &LegSwap::first_frame);
  return result;
}

}  // namespace stride::tracking
