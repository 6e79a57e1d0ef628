#include "videos/pinhole_camera.h"

#include <gtest/gtest.h>

namespace stride::videos {
namespace {

PinholeCamera tilted(bool from_left) {
  PinholeCamera camera;
  camera.x_m = 3.2;
  camera.roll_rad = 0.1;
  camera.pixel_aspect = 1.1;
  camera.from_left = from_left;
  return camera;
}

TEST(PinholeCamera, LooksBackThroughAPixelToThePointThatItShows) {
  for (const bool from_left : {false, true}) {
    const PinholeCamera camera = tilted(from_left);
    const Eigen::Vector3d p(3.7, 0.4, -0.6);
    const Eigen::Vector2d pixel = camera.project(p);
    EXPECT_LT((camera.on_plane(pixel.x(), pixel.y(), p.z()) - p.head<2>()).norm(), 1e-12);
  }
}

TEST(PinholeCamera, OnTheLeftSeesARunToTheLeftAndTheLeftLegNearer) {
  const Eigen::Vector3d before(4, 1, 0), left_hip(3, 1, -0.1), right_hip(3, 1, 0.1);
  for (const bool from_left : {false, true}) {
    const PinholeCamera camera = tilted(from_left);
    EXPECT_EQ(camera.project(before).x() < camera.project({3, 1, 0}).x(), from_left);
    EXPECT_EQ(camera.depth(left_hip.z()) < camera.depth(right_hip.z()), from_left);
  }
}

TEST(PinholeCamera, WithPositiveRollShowsTheGroundRisingToTheRight) {
  const PinholeCamera camera = tilted(false);
  const Eigen::Vector2d left = camera.project({2, 0, 0}), right = camera.project({4, 0, 0});
  const double rise = left.y() - right.y(), run = 1.1 * (right.x() - left.x());
  EXPECT_NEAR(std::atan2(rise, run), 0.1, 1e-12);
}

}  // namespace
}  // namespace stride::videos
