#include "videos/skeleton.h"

#include <gtest/gtest.h>

#include <cmath>

#include "extract/io/table.h"
#include "videos/clip.h"
#include "videos/gait.h"

namespace stride::videos {
namespace {

// The angles (mean of both legs) and the positions (right leg) of the trial were computed from its
// markers separately.
TEST(Skeleton, MovesKneesAndAnklesAsMeasured) {
  const Table measured = load_csv(STRIDE_TEST_DATA "/rajagopal_run4.csv");
  double knee = 0, ankle = 0;
  for (const auto& row : measured.rows) {
    const Skeleton s = pose(rajagopal_run(), {}, row[0], 0, 0.9);
    knee += ((s.knee[0] - s.pelvis).head<2>() - Eigen::Vector2d(row[1], row[2])).squaredNorm();
    ankle += ((s.ankle[0] - s.pelvis).head<2>() - Eigen::Vector2d(row[3], row[4])).squaredNorm();
  }
  const auto count = static_cast<double>(measured.rows.size());
  EXPECT_LT(std::sqrt(knee / count), 0.03);
  EXPECT_LT(std::sqrt(ankle / count), 0.03);
}

TEST(Skeleton, IsTheSameHalfAStrideLaterWithLegsExchanged) {
  const Gait gait = rajagopal_run();
  const Skeleton now = pose(gait, {}, 0.2, 0, 0.9), later = pose(gait, {}, 0.7, 0, 0.9);
  for (const BodyPart part : kBodyParts) {
    const Eigen::Vector3d mirrored_point =
        later[mirrored(part)].cwiseProduct(Eigen::Vector3d(1, 1, -1));
    EXPECT_LT((now[part] - mirrored_point).norm(), 0.004) << name(part);
  }
}

TEST(Skeleton, StandsOnTheGroundAndDoesNotSlide) {
  const Gait gait = rajagopal_run();
  const Grounding grounding = ground(gait, {});
  // The trial's belt ran at 3.5–3.9 m/s in stance.
  EXPECT_GT(grounding.speed_m_s, 3.5);
  EXPECT_LT(grounding.speed_m_s, 3.9);
  double lowest = 1;
  for (int i = 0; i < 100; ++i) {
    const double phase = i / 100.0;
    const double height =
        grounding.mean_height_m + gait.pelvis_height_m(phase) - gait.pelvis_height_m.mean;
    lowest = std::min(lowest, clearance(pose(gait, {}, phase, 0, height), {}, 0));
  }
  EXPECT_NEAR(lowest, 0, 0.002);
}

TEST(Skeleton, OfEveryClipTouchesTheGroundAndHardlySinksIn) {
  for (const Clip& clip : clips()) {
    const Motion motion(clip);
    double lowest = 1, highest = 0;
    for (int i = 0; i < clip.frames; ++i) {
      const Skeleton s = motion.skeleton(i / clip.rate_hz);
      const double lower =
          std::min(clearance(s, clip.proportions, 0), clearance(s, clip.proportions, 1));
      lowest = std::min(lowest, lower);
      highest = std::max(highest, lower);
    }
    EXPECT_GT(lowest, -0.02) << clip.name;
    EXPECT_LT(lowest, 0.02) << clip.name;
    // Only who runs leaves the ground.
    EXPECT_EQ(highest > 0.03, clip.name != "walk") << clip.name << ' ' << highest;
  }
}

}  // namespace
}  // namespace stride::videos
