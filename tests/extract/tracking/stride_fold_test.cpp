#include "extract/tracking/stride_fold.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "extract/io/random.h"

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr double kPeriod_s = 0.72;

/// A foot about the pelvis, px: it swings high and comes back low.
Vector2d foot(int side, double time_s) {
  const double turn = 2 * std::numbers::pi * (time_s / kPeriod_s + 0.5 * side);
  return {60 * std::cos(turn) + 6 * std::cos(2 * turn),
          90 - 14 * std::sin(turn) - 5 * std::sin(2 * turn)};
}
Vector2d knee(int side, double time_s) {
  const double turn = 2 * std::numbers::pi * (time_s / kPeriod_s + 0.5 * side);
  return {25 * std::cos(turn - 0.6), 45 + 4 * std::sin(2 * turn)};
}

struct Seen {
  std::vector<std::vector<JointPair>> joints{2};
  std::vector<double> times_s;
};

/// 3 strides at 30 frames a second with 0.5 px of noise; `exchanged`: share of the frames on which
/// right and left have each other's names.
Seen seen(double exchanged) {
  Random random(5);
  Seen result;
  for (int f = 0; f < 65; ++f) {
    const double time_s = f / 30.0;
    const bool swapped = uniform(random) < exchanged;
    result.times_s.push_back(time_s);
    for (const int joint : {0, 1}) {
      JointPair pair;
      for (const int side : {0, 1}) {
        const int named = swapped ? 1 - side : side;
        const Vector2d noise(0.5 * normal(random), 0.5 * normal(random));
        pair.p_px[named] = (joint == 0 ? knee(side, time_s) : foot(side, time_s)) + noise;
        pair.weight[named] = 1;
      }
      result.joints[joint].push_back(pair);
    }
  }
  return result;
}

TEST(StrideFold, PutsEachJointWhereItIsAtAnyTime) {
  const Seen clip = seen(0);
  const auto fold = fold_stride(clip.joints, clip.times_s);
  ASSERT_TRUE(fold.has_value());
  for (const double time_s : {0.11, 0.5, 1.3})
    for (const int side : {0, 1}) {
      EXPECT_LT((fold->place(0, side, time_s) - knee(side, time_s)).norm(), 1);
      // An error of the period by 0.3 % is 1.7 px at the ends of the clip.
      EXPECT_LT((fold->place(1, side, time_s) - foot(side, time_s)).norm(), 2.5);
    }
  EXPECT_LT(fold->spread_px[1], 2);
}

TEST(StrideFold, FindsThePeriodUnderAnyNames) {
  for (const double exchanged : {0.0, 0.3, 0.5}) {
    const Seen clip = seen(exchanged);
    const auto fold = fold_stride(clip.joints, clip.times_s);
    ASSERT_TRUE(fold.has_value());
    EXPECT_NEAR(fold->period_s, kPeriod_s, 0.005 * kPeriod_s) << exchanged;
  }
}

TEST(StrideFold, SaysNothingOfAFewFrames) {
  Seen clip = seen(0);
  clip.times_s.resize(4);
  for (auto& joint : clip.joints) joint.resize(4);
  EXPECT_FALSE(fold_stride(clip.joints, clip.times_s).has_value());
}

}  // namespace
}  // namespace stride::tracking
