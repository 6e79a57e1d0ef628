// The one estimator of a stride's period, against motions whose period is known.
#include "extract/skeleton/stride_period.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace stride {
namespace {

struct Motion {
  std::vector<double> times_s;
  std::vector<std::vector<JointPair>> joints;
};

/// Two joints that go round with two harmonics, the left half a period behind, 1 px of noise.
Motion motion(double period_s, double rate_hz, double duration_s, bool names_are_right = true) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0, 1);
  Motion m;
  m.joints.resize(2);
  for (int i = 0; i < rate_hz * duration_s; ++i) {
    m.times_s.push_back(i / rate_hz);
    for (int joint = 0; joint < 2; ++joint) {
      JointPair pair{{}, {1, 1}};
      for (int side = 0; side < 2; ++side) {
        const double a = 2 * std::numbers::pi * (m.times_s.back() / period_s + 0.5 * side),
                     size = 20 * (joint + 1);
        pair.p_px[side] = {size * std::cos(a) + noise(random),
                           50 + size * (0.5 * std::sin(a) + 0.3 * std::cos(2 * a)) + noise(random)};
      }
      if (!names_are_right && random() % 2 == 0) std::swap(pair.p_px[0], pair.p_px[1]);
      m.joints[static_cast<std::size_t>(joint)].push_back(pair);
    }
  }
  return m;
}

TEST(StridePeriod, IsFoundFromASprintToSlowMotion) {
  for (const double period_s : {0.4, 0.7, 1.1, 2.5, 5.5}) {
    const Motion m = motion(period_s, 30, 4 * period_s);
    const auto found = stride_periods(m.joints, m.times_s, LegNames::trusted, 3);
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(found[0].period_s, period_s, 0.02 * period_s);
    EXPECT_GT(found[0].explained, 0.95);
  }
}

TEST(StridePeriod, IsFoundWhereTheLegsAreNotTold) {
  for (const double period_s : {0.7, 2.5}) {
    const Motion m = motion(period_s, 30, 4 * period_s, /*names_are_right=*/false);
    const auto found = stride_periods(m.joints, m.times_s, LegNames::unknown, 1);
    ASSERT_FALSE(found.empty());
    // Twice the period explains it too: fold_stride() tells them apart.
    const double multiple = std::round(found[0].period_s / period_s);
    EXPECT_TRUE(multiple == 1 || multiple == 2);
    EXPECT_NEAR(found[0].period_s, multiple * period_s, 0.02 * multiple * period_s);
  }
}

TEST(StridePeriod, IsNoAliasOfTheFrames) {
  // At 3.75 Hz a stride of 5.5 s looks like one of 0.28 s in reverse.
  const Motion m = motion(5.5, 3.75, 25);
  const auto found = stride_periods(m.joints, m.times_s, LegNames::trusted, 3);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found[0].period_s, 5.5, 0.1);
  for (const StridePeriod& each : found) EXPECT_GE(each.period_s, 3 / 3.75);
}

TEST(StridePeriod, OfALongClipIsThatOfItsMiddle) {
  const Motion m = motion(0.7, 30, 120);
  const auto found = stride_periods(m.joints, m.times_s, LegNames::trusted, 1);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found[0].period_s, 0.7, 0.01);
}

TEST(StridePeriod, IsNotToldByAFewFrames) {
  const Motion m = motion(0.7, 30, 0.3);
  EXPECT_TRUE(stride_periods(m.joints, m.times_s, LegNames::trusted, 3).empty());
}

TEST(PeriodBounds, AreThoseOfTheSamplingAndTheClip) {
  const PeriodBounds at_4_hz = period_bounds({0, 0.25, 0.5, 0.75, 4});
  EXPECT_DOUBLE_EQ(at_4_hz.shortest_s, 0.75);
  EXPECT_DOUBLE_EQ(at_4_hz.longest_s, 4.4);
  EXPECT_DOUBLE_EQ(period_bounds({}).shortest_s, kShortestPeriod_s);
}

}  // namespace
}  // namespace stride
