#include "videos/variant.h"

#include <gtest/gtest.h>

#include "videos/truth.h"

namespace stride::videos {
namespace {

TEST(Variant, OfTheSizeHasTheSameTruthInLargerPixels) {
  const Clip clip = stride::videos::clip("human");
  const Trajectory truth = truth_px(clip), twice = truth_px(resized(clip, 2));
  for (const BodyPart part : kAskedParts) {
    const Eigen::Vector2d p = truth.frames[40][part].p_px, q = twice.frames[40][part].p_px;
    EXPECT_LT((2 * p.array() + 0.5 - q.array()).matrix().norm(), 1e-9) << name(part);
  }
}

TEST(Variant, OfTheRateShowsTheSameMoments) {
  const Clip clip = stride::videos::clip("human");
  const Trajectory truth = truth_px(clip);
  for (const Clip& variant : {at_rate(clip, 60), in_slow_motion(clip, 2)}) {
    const Trajectory twice = truth_px(variant);
    ASSERT_EQ(twice.frames.size(), 2 * truth.frames.size());
    EXPECT_NEAR(twice.rate_hz, 60, 1e-9);
    for (const int i : {0, 17, 95}) {
      EXPECT_NEAR(twice.frames[2 * i].time_s, truth.frames[i].time_s, 1e-12);
      EXPECT_LT(
          (twice.frames[2 * i][BodyPart::ankle_l].p_px - truth.frames[i][BodyPart::ankle_l].p_px)
              .norm(),
          1e-9);
    }
    EXPECT_EQ(clicks(variant).frames.size(), clicks(clip).frames.size());
  }
  EXPECT_EQ(clicks(in_slow_motion(clip, 2)).slow_motion, 2);
}

TEST(Variant, FromTheOtherSideIsTheSameRunTheOtherWay) {
  const Clip clip = stride::videos::clip("human"), other = from_other_side(clip);
  EXPECT_EQ(truth_m(clip).rows, truth_m(other).rows);
  const Trajectory truth = truth_px(clip), mirrored = truth_px(other);
  EXPECT_EQ(mirrored.direction, Facing::left);
  const auto ahead = [](const TrajectoryFrame& frame) {
    return frame[BodyPart::toe_r].p_px.x() - frame[BodyPart::ankle_r].p_px.x();
  };
  for (std::size_t i = 0; i < truth.frames.size(); ++i)
    if (std::abs(ahead(truth.frames[i])) > 3) {
      EXPECT_LT(ahead(truth.frames[i]) * ahead(mirrored.frames[i]), 0);
    }
}

TEST(Variant, FromOnePlaceKeepsTheRunnerInTheFrame) {
  const Clip clip = from_one_place(stride::videos::clip("human"));
  const Trajectory truth = truth_px(clip);
  for (const TrajectoryFrame& frame : truth.frames)
    for (const BodyPart part : kAskedParts) {
      const Point& point = frame[part];
      EXPECT_GT(point.p_px.minCoeff(), 0);
      EXPECT_LT(point.p_px.x(), clip.width_px);
      EXPECT_LT(point.p_px.y(), clip.height_px);
    }
  EXPECT_GT(truth.frames.back()[BodyPart::pelvis].p_px.x() -
                truth.frames.front()[BodyPart::pelvis].p_px.x(),
            0.7 * clip.width_px);
}

}  // namespace
}  // namespace stride::videos
