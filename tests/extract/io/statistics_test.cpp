#include "extract/io/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stride {
namespace {

TEST(Statistics, MedianIsTheUpperOfTheTwoInTheMiddle) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 3);
  EXPECT_TRUE(std::isnan(median({})));
}

}  // namespace
}  // namespace stride
