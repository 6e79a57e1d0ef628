#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "extract/io/table.h"
#include "extract/tracking/leg_identity.h"

namespace stride {

/// The points of a clip's truth as a detector would give them: without the head.
inline Trajectory detected(const std::string& truth_file) {
  const Table table = load_csv(truth_file);
  Trajectory truth;
  truth.video = truth_file;
  for (const auto& row : table.rows) {
    TrajectoryFrame& frame = truth.frames.emplace_back();
    frame.frame = static_cast<int>(row[table.column("frame")]);
    frame.time_s = row[table.column("time_s")];
    for (const BodyPart part : kAskedParts) {
      const std::string prefix(name(part));
      if (part != BodyPart::head)
        frame[part] = {{row[table.column(prefix + "_x")], row[table.column(prefix + "_y")]},
                       Source::detected,
                       0.9};
    }
  }
  return truth;
}

struct Spoiled {
  Trajectory points;
  std::vector<bool> swapped;
};

/// 3 px noise, a tenth of the points missing, 5–30 % of the frames swapped, alone and in runs.
inline Spoiled spoiled(const Trajectory& truth, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const auto normal = [&] {
    double sum = -6;  // Irwin and Hall
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  };
  Spoiled result{truth, std::vector<bool>(truth.frames.size())};
  const double share = 0.05 + 0.25 * uniform();
  const auto n = result.swapped.size();
  while (std::count(result.swapped.begin(), result.swapped.end(), true) <
         share * static_cast<double>(n)) {
    const std::size_t length = uniform() < 0.5 ? 1 : 1 + random() % 8, at = random() % n;
    for (std::size_t i = at; i < std::min(n, at + length); ++i) result.swapped[i] = true;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (const BodyPart part : kAskedParts) {
      Point& point = result.points.frames[i][part];
      if (!point.present()) continue;
      const double y = normal(), x = normal();
      point.p_px += 3 * Eigen::Vector2d(x, y);
      if (uniform() < 0.1) point = Point();
    }
    if (result.swapped[i]) tracking::swap_legs(result.points.frames[i]);
  }
  return result;
}

/// Frames that come out right.
inline int repaired(const Spoiled& clip) {
  const tracking::LegIdentity legs = tracking::repair_legs(clip.points);
  int right = 0;
  for (std::size_t i = 0; i < clip.swapped.size(); ++i)
    right += clip.swapped[i] == std::ranges::any_of(legs.swaps, [&](const tracking::LegSwap& swap) {
               const int frame = clip.points.frames[i].frame;
               return swap.first_frame <= frame && frame <= swap.last_frame;
             });
  return right;
}

}  // namespace stride
