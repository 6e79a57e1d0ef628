#include "extract/leg_identity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "extract/table.h"

namespace stride {
namespace {

/// The truth of the clip that ships with the project.
Trajectory human() {
  const Table table = load_csv(STRIDE_SOURCE_DIR "/videos/human.truth.csv");
  Trajectory truth;
  truth.video = "human.mp4";
  for (const auto& row : table.rows) {
    TrajectoryFrame& frame = truth.frames.emplace_back();
    frame.frame = static_cast<int>(row[table.column("frame")]);
    frame.time_s = row[table.column("time_s")];
    for (const BodyPart part : kBodyParts) {
      const std::string prefix(name(part));
      if (part != BodyPart::head)
        frame[part] = {{row[table.column(prefix + "_x")], row[table.column(prefix + "_y")]}, 0.9};
    }
  }
  return truth;
}

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

double normal(std::mt19937_64& random) {
  double sum = -6;  // Irwin and Hall
  for (int i = 0; i < 12; ++i) sum += uniform(random);
  return sum;
}

struct Spoiled {
  Trajectory points;
  std::vector<bool> swapped;
};

/// 3 px noise, a tenth of the points missing, 5–30 % of the frames swapped, alone and in runs.
Spoiled spoiled(const Trajectory& truth, unsigned seed) {
  std::mt19937_64 random(seed);
  Spoiled result{truth, std::vector<bool>(truth.frames.size())};
  const double share = 0.05 + 0.25 * uniform(random);
  const auto n = result.swapped.size();
  while (std::count(result.swapped.begin(), result.swapped.end(), true) <
         share * static_cast<double>(n)) {
    const std::size_t length = uniform(random) < 0.5 ? 1 : 1 + random() % 8, at = random() % n;
    for (std::size_t i = at; i < std::min(n, at + length); ++i) result.swapped[i] = true;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (const BodyPart part : kBodyParts) {
      Point& point = result.points.frames[i][part];
      if (!point.present()) continue;
      point.p_px += 3 * Eigen::Vector2d(normal(random), normal(random));
      if (uniform(random) < 0.1) point = Point();
    }
    if (result.swapped[i]) swap_legs(result.points.frames[i]);
  }
  return result;
}

bool says_swapped(const LegIdentity& legs, int frame) {
  return std::ranges::any_of(legs.swaps, [&](const LegSwap& swap) {
    return swap.first_frame <= frame && frame <= swap.last_frame;
  });
}

TEST(LegIdentity, RepairsInjectedSwaps) {
  const Trajectory truth = human();
  int right = 0, frames = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Spoiled spoiled_clip = spoiled(truth, seed);
    const LegIdentity legs = repair_legs(spoiled_clip.points);
    for (std::size_t i = 0; i < truth.frames.size(); ++i, ++frames)
      right += says_swapped(legs, truth.frames[i].frame) == spoiled_clip.swapped[i];
  }
  EXPECT_GE(right, 0.99 * frames) << right << " of " << frames;
}

TEST(LegIdentity, RepairsARunToTheLeftWithFewPartsAtHalfTheRate) {
  Trajectory truth = human();
  std::erase_if(truth.frames, [](const TrajectoryFrame& frame) { return frame.frame % 2 == 1; });
  for (TrajectoryFrame& frame : truth.frames)
    for (const BodyPart part : kBodyParts) {
      frame[part].p_px.x() = 639 - frame[part].p_px.x();
      if (std::ranges::find(kRequiredParts, part) == kRequiredParts.end()) frame[part] = Point();
    }
  int right = 0, frames = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Spoiled spoiled_clip = spoiled(truth, seed);
    const LegIdentity legs = repair_legs(spoiled_clip.points);
    for (std::size_t i = 0; i < truth.frames.size(); ++i, ++frames)
      right += says_swapped(legs, truth.frames[i].frame) == spoiled_clip.swapped[i];
  }
  EXPECT_GE(right, 0.97 * frames) << right << " of " << frames;
}

TEST(LegIdentity, LeavesRightNamesAloneAndFindsThePeriod) {
  const Trajectory truth = human();
  const LegIdentity legs = repair_legs(truth);
  EXPECT_TRUE(legs.swaps.empty());
  EXPECT_NEAR(legs.period_s, 0.687, 0.02);  // the clip's README
}

TEST(LegIdentity, ExplainsASwapAndNeverOverrulesAClick) {
  Trajectory points = human();
  for (const std::size_t i : {20u, 21u, 22u}) swap_legs(points.frames[i]);
  const LegIdentity legs = repair_legs(points);
  ASSERT_EQ(legs.swaps.size(), 1u);
  EXPECT_EQ(legs.swaps[0].first_frame, 20);
  EXPECT_EQ(legs.swaps[0].last_frame, 22);
  EXPECT_FALSE(legs.swaps[0].why.empty());
  EXPECT_GT(legs.swaps[0].evidence, 0);

  LegIdentityOptions options;
  options.clicked_frames = {20, 21, 22};  // then it is the other frames that are wrong
  const LegIdentity told = repair_legs(points, options);
  for (const int frame : {20, 21, 22}) EXPECT_FALSE(says_swapped(told, frame)) << frame;
}

TEST(LegIdentity, MovesAFootThatHangsOnTheWrongKnee) {
  const Trajectory truth = human();
  Trajectory points = truth;
  TrajectoryFrame& frame = points.frames[13];  // the legs are far apart
  std::swap(frame[BodyPart::ankle_r], frame[BodyPart::ankle_l]);
  std::swap(frame[BodyPart::toe_r], frame[BodyPart::toe_l]);
  const LegIdentity legs = repair_legs(points);
  EXPECT_EQ(legs.repaired.frames[13][BodyPart::ankle_r].p_px,
            truth.frames[13][BodyPart::ankle_r].p_px);
}

}  // namespace
}  // namespace stride
