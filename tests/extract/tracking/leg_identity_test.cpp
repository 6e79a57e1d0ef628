#include "extract/tracking/leg_identity.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "extract/io/random.h"
#include "tests/support/spoiled_legs.h"

namespace stride {
namespace {

const Trajectory& human() {
  static const Trajectory truth = detected(STRIDE_SOURCE_DIR "/videos/human.truth.csv");
  return truth;
}

bool says_swapped(const tracking::LegIdentity& legs, int frame) {
  return std::ranges::any_of(legs.swaps, [&](const tracking::LegSwap& swap) {
    return swap.first_frame <= frame && frame <= swap.last_frame;
  });
}

TEST(LegIdentity, ExchangesEveryPartOfTheLegs) {
  TrajectoryFrame frame;
  for (const BodyPart part : kBodyParts)
    frame[part] = {{1.0 * index(part), 0}, Source::detected, 1};
  tracking::swap_legs(frame);
  for (const BodyPart part : kBodyParts)
    EXPECT_EQ(frame[part].p_px.x(), index(mirrored(part))) << name(part);
}

TEST(LegIdentity, RepairsInjectedSwaps) {
  const Trajectory truth = human();
  int right = 0, frames = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    right += repaired(spoiled(truth, seed));
    frames += static_cast<int>(truth.frames.size());
  }
  EXPECT_GE(right, 0.99 * frames) << right << " of " << frames;
}

TEST(LegIdentity, RepairsARunToTheLeftWithFewPartsAtHalfTheRate) {
  Trajectory truth = human();
  std::erase_if(truth.frames, [](const TrajectoryFrame& frame) { return frame.frame % 2 == 1; });
  for (TrajectoryFrame& frame : truth.frames)
    for (const BodyPart part : kAskedParts) {
      frame[part].p_px.x() = 639 - frame[part].p_px.x();
      if (std::ranges::find(kRequiredParts, part) == kRequiredParts.end()) frame[part] = Point();
    }
  int right = 0, frames = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    right += repaired(spoiled(truth, seed));
    frames += static_cast<int>(truth.frames.size());
  }
  EXPECT_GE(right, 0.99 * frames) << right << " of " << frames;
}

/// A person's clicks_of every `spacing` frames, without hips, 1.5 px noise.
Trajectory clicks_of(const char* clip, int spacing) {
  Trajectory points = detected(fmt::format(STRIDE_SOURCE_DIR "/videos/{}.truth.csv", clip));
  std::erase_if(points.frames, [&](const TrajectoryFrame& f) { return f.frame % spacing != 1; });
  Random random(7);
  for (TrajectoryFrame& frame : points.frames)
    for (const BodyPart part : kAskedParts) {
      if (part == BodyPart::hip_r || part == BodyPart::hip_l) frame[part] = Point();
      const double x = normal(random), y = normal(random);
      frame[part].p_px += 1.5 * Eigen::Vector2d(x, y);
      frame[part].confidence = 1;
    }
  return points;
}

TEST(LegIdentity, SuspectsASwappedFrameAmongSparseClicks) {
  for (const char* clip : {"human", "game", "small", "walk"})
    for (const int spacing : {4, 6}) {
      const Trajectory points = clicks_of(clip, spacing);
      EXPECT_TRUE(tracking::repair_legs(points).swaps.empty()) << clip << " every " << spacing;
      Trajectory swapped = points;
      tracking::swap_legs(swapped.frames[8]);
      const tracking::LegIdentity legs = tracking::repair_legs(swapped);
      ASSERT_EQ(legs.swaps.size(), 1u) << clip << " every " << spacing;
      EXPECT_EQ(legs.swaps[0].first_frame, points.frames[8].frame);
      EXPECT_EQ(legs.swaps[0].last_frame, points.frames[8].frame);
    }
}

TEST(LegIdentity, LeavesRightNamesAloneAndFindsThePeriod) {
  const Trajectory truth = human();
  const tracking::LegIdentity legs = tracking::repair_legs(truth);
  EXPECT_TRUE(legs.swaps.empty());
  EXPECT_NEAR(legs.period_s, 0.687, 0.02);  // the clip's README
}

TEST(LegIdentity, ExplainsASwapAndNeverOverrulesAClick) {
  Trajectory points = human();
  for (const std::size_t i : {20u, 21u, 22u}) tracking::swap_legs(points.frames[i]);
  const tracking::LegIdentity legs = tracking::repair_legs(points);
  ASSERT_EQ(legs.swaps.size(), 1u);
  EXPECT_EQ(legs.swaps[0].first_frame, 20);
  EXPECT_EQ(legs.swaps[0].last_frame, 22);
  EXPECT_FALSE(legs.swaps[0].why.empty());
  EXPECT_GT(legs.swaps[0].evidence, 0);

  tracking::LegIdentityOptions options;
  options.clicked_frames = {20, 21, 22};  // then it is the other frames that are wrong
  const tracking::LegIdentity told = tracking::repair_legs(points, options);
  for (const int frame : {20, 21, 22}) EXPECT_FALSE(says_swapped(told, frame)) << frame;
}

TEST(LegIdentity, MovesAFootThatHangsOnTheWrongKnee) {
  const Trajectory truth = human();
  Trajectory points = truth;
  TrajectoryFrame& frame = points.frames[13];  // the legs are far apart
  std::swap(frame[BodyPart::ankle_r], frame[BodyPart::ankle_l]);
  std::swap(frame[BodyPart::toe_r], frame[BodyPart::toe_l]);
  const tracking::LegIdentity legs = tracking::repair_legs(points);
  EXPECT_EQ(legs.repaired.frames[13][BodyPart::ankle_r].p_px,
            truth.frames[13][BodyPart::ankle_r].p_px);
}

}  // namespace
}  // namespace stride
