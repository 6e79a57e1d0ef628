#include "train/environment/late_positions.h"

#include <gtest/gtest.h>

#include <vector>

namespace stride::environment {
namespace {

/// What OpenSim was measured to do while running: 9 to 17 % of the rows, all six bodies at once,
/// never the pelvis, 1 to 5 steps old, in clusters.
TEST(LatePositions, AreLateAsOftenAndAsMuchAsOpenSims) {
  LatePositions late;
  std::vector<int> ages(10);
  int rows = 0, clusters = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    late.start(seed);
    int before = 0;
    for (int row = 0; row < 1000; ++row, ++rows) {
      Eigen::VectorXd observation = Eigen::VectorXd::Constant(41, row);
      late.apply(observation);
      const int age = row - static_cast<int>(observation[22]);
      for (int i = 0; i < 41; ++i) {
        const bool body = i >= 22 && i <= 35 && i != 24 && i != 25;
        ASSERT_EQ(observation[i], row - (body ? age : 0)) << i;
      }
      ASSERT_LT(age, 10);
      ++ages[static_cast<std::size_t>(age)];
      clusters += age > 0 && before == 0;
      before = age;
    }
  }
  const double share = 1 - ages[0] / static_cast<double>(rows);
  EXPECT_GT(share, 0.09);
  EXPECT_LT(share, 0.17);
  EXPECT_GT(clusters, 500);
  for (int age = 1; age <= LatePositions::kLongest; ++age)
    EXPECT_GT(ages[static_cast<std::size_t>(age)], 100) << age;
}

}  // namespace
}  // namespace stride::environment
