#include "train/evaluation/episodes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stride::evaluation {
namespace {

network::EpisodeSummary episode(double distance_m, bool fell) {
  return {.distance_m = distance_m, .fell = fell};
}

TEST(EpisodeStatistics, AreThoseOfTheFormulas) {
  const EpisodeStatistics found = statistics_of(
      {episode(40, false), episode(10, true), episode(44, false), episode(42, false)});
  EXPECT_DOUBLE_EQ(found.distance_m, 34);
  EXPECT_DOUBLE_EQ(found.finished_distance_m, 42);
  EXPECT_EQ(found.falls, 1);
  const double se = std::sqrt((36 + 576 + 100 + 64) / 3.0 / 4);
  EXPECT_NEAR(found.distance_se_m, se, 1e-12);
  EXPECT_NEAR(found.distance_95_m.second - 34, 1.96 * se, 1e-3);
  // Wilson's interval of 1 in 4 as other programs print it.
  EXPECT_NEAR(found.fall_share_95.first, 0.0456, 1e-4);
  EXPECT_NEAR(found.fall_share_95.second, 0.6994, 1e-4);
}

TEST(EpisodeStatistics, OfOneEpisodeHaveNoSpread) {
  const EpisodeStatistics found = statistics_of({episode(5, true)});
  EXPECT_EQ(found.distance_m, 5);
  EXPECT_TRUE(std::isnan(found.distance_se_m));
  EXPECT_TRUE(std::isnan(found.finished_distance_m));
}

TEST(EpisodeStatistics, MedianIsTheLowerOfTwo) {
  EXPECT_EQ(median_episode({episode(3, false), episode(1, false), episode(2, false)}), 2u);
  EXPECT_EQ(median_episode({episode(3, false), episode(1, false)}), 1u);
}

}  // namespace
}  // namespace stride::evaluation
