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

TEST(Statistics, StudentsQuantilesAreThoseOfTheTables) {
  // NIST/SEMATECH e-Handbook, 1.3.6.7.2: upper critical values, probability 0.975.
  const std::pair<int, double> table[] = {{1, 12.706}, {2, 4.303},  {4, 2.776},  {9, 2.262},
                                          {10, 2.228}, {11, 2.201}, {12, 2.179}, {20, 2.086},
                                          {30, 2.042}, {60, 2.000}, {100, 1.984}};
  for (const auto& [degrees, t] : table)
    EXPECT_NEAR(student_quantile(0.975, degrees), t, 0.0005) << degrees << " degrees of freedom";
  EXPECT_NEAR(student_quantile(0.95, 5), 2.015, 0.0005);
  EXPECT_NEAR(student_quantile(0.025, 5), -2.571, 0.0005);
}

}  // namespace
}  // namespace stride
