#include "extract/tracking/track_score.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stride::tracking {
namespace {

using testing::HasSubstr;

TEST(TrackScore, OfSparseExactClicksIsBetterThanTheirSpline) {
  ScoreOptions options;
  options.spacings = {6};
  options.noises_px = {0};
  const std::string videos = std::string(STRIDE_SOURCE_DIR) + "/videos/";
  const std::vector<TrackScore> scores =
      score_tracking(videos + "human.mp4", videos + "human.truth.csv", options);
  ASSERT_EQ(scores.size(), 1U);
  EXPECT_EQ(scores[0].spacing_frames, 6);
  EXPECT_GT(scores[0].spline_px, 2);  // that spline misses what happens between six frames
  EXPECT_GT(scores[0].gain(), 2);
  EXPECT_LT(scores[0].tracked_px, scores[0].tracked_p95_px);
  EXPECT_NEAR(scores[0].period_s, 0.6867, 0.003);
  int points = 0;
  for (const Reliability& bin : scores[0].by_confidence) points += bin.points;
  EXPECT_GT(points, 4 * 60);  // four joints, unclicked frames
}

TEST(TrackScore, TableHasARowForEachSpacingAndEachConfidence) {
  TrackScore score;
  score.spacing_frames = 5;
  score.spline_px = 6;
  score.tracked_px = 2;
  score.by_confidence[3] = {.points = 200, .near = 150};
  score.by_confidence[9] = {.points = 10, .near = 10};
  const std::string table = table_of({score, score});
  EXPECT_THAT(table, HasSubstr("| 5 frames | 0 | 6.00 | 0.00 | 2.00 | 0.00 | 3.0× |"));
  EXPECT_THAT(table, HasSubstr("| 0.3 to 0.4 | 400 | 75.0 % |"));
  EXPECT_THAT(table, HasSubstr("| 0.9 to 1.0 | 20 | 100.0 % |"));
}

}  // namespace
}  // namespace stride::tracking
