#include "extract/tracking/time_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace stride::tracking {
namespace {

using testing::HasSubstr;

TEST(TimeCheck, NamesTheLikelyFactor) {
  EXPECT_EQ(doubt_of_period(0.7), "");
  EXPECT_EQ(likely_slow_motion(2.5), 3.5);
  EXPECT_THAT(doubt_of_period(2.5), HasSubstr("slow motion by about 3.5? say --slow-motion 3.5"));
  EXPECT_THAT(doubt_of_period(0.2), HasSubstr("does it play too fast, by about 0.28?"));
}

TEST(TimeCheck, TellsWhatTheFileSaysOfItsRates) {
  EXPECT_EQ(doubt_of_rates(std::nan(""), 30), "");
  EXPECT_EQ(doubt_of_rates(30, 30), "");
  EXPECT_THAT(doubt_of_rates(120, 30), HasSubstr("slow motion by 4? say --slow-motion 4"));
  EXPECT_THAT(doubt_of_rates(std::nan(""), 240), HasSubstr("240 frames a second"));
}

}  // namespace
}  // namespace stride::tracking
