#include "extract/leg_identity.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/spoiled_legs.h"

namespace stride {
namespace {

const Trajectory& human() {
  static const Trajectory truth = detected(STRIDE_SOURCE_DIR "/videos/human.truth.csv");
  return truth;
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
    right += repaired(spoiled(truth, seed));
    frames += static_cast<int>(truth.frames.size());
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
    right += repaired(spoiled(truth, seed));
    frames += static_cast<int>(truth.frames.size());
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
