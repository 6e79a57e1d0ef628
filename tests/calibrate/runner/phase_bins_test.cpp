#include "calibrate/runner/phase_bins.h"

#include <gtest/gtest.h>

namespace stride {
namespace {

CalibratedSample sample(double phase, double knee) {
  CalibratedSample made;
  made.phase = phase;
  made.coordinates[4] = knee;
  return made;
}

TEST(PhaseBins, AverageTheStridesOfAClip) {
  CalibratedTrajectory clip;
  clip.samples = {sample(0.1, 1), sample(0.6, 5), sample(0.2, 3)};
  const std::vector<PhaseBin> bins = phase_bins(clip, 4, 10);
  ASSERT_EQ(bins.size(), 4u);
  EXPECT_EQ(bins[0].count, 2);
  EXPECT_DOUBLE_EQ(bins[0].phase, 0.15);
  EXPECT_DOUBLE_EQ(bins[0].mean[4], 20);
  EXPECT_DOUBLE_EQ(bins[0].sd[4], 10);
  EXPECT_EQ(bins[0].sd[3], 0);
  EXPECT_EQ(bins[1].count, 0);
  EXPECT_EQ(bins[2].mean[4], 50);
}

TEST(PhaseBins, TheEndOfAMovementIsInTheLast) {
  EXPECT_EQ(phase_bin(0, 40), 0u);
  EXPECT_EQ(phase_bin(0.5, 40), 20u);
  EXPECT_EQ(phase_bin(1, 40), 39u);
}

}  // namespace
}  // namespace stride
