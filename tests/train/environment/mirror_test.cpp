#include "train/environment/mirror.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "tests/support/throws.h"

namespace stride {
namespace {

TEST(Mirror, SwapsTheSidesInNamesAndOnlyThose) {
  EXPECT_EQ(environment::mirrored_name("knee_angle_r"), "knee_angle_l");
  EXPECT_EQ(environment::mirrored_name("talus_l_vx"), "talus_r_vx");
  EXPECT_EQ(environment::mirrored_name("activation_glut_max_r"), "activation_glut_max_l");
  EXPECT_EQ(environment::mirrored_name("pelvis_tilt"), "pelvis_tilt");
  EXPECT_EQ(environment::mirrored_name("roll_rate"), "roll_rate");
}

TEST(Mirror, IsItsOwnInverse) {
  const environment::Mirror mirror = environment::mirror_by_name(
      {"hip_r", "pelvis", "knee_l_x", "hip_l", "phase_sin", "phase_cos", "knee_r_x"});
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(7, 1, 7);
  Eigen::VectorXd once(7), twice(7);
  mirror.apply(x, once);
  mirror.apply(once, twice);
  EXPECT_EQ(twice, x);
  EXPECT_EQ(once, (Eigen::VectorXd(7) << 4, 2, 7, 1, -5, -6, 3).finished());
}

TEST(Mirror, MissingOtherSideIsNamed) {
  EXPECT_ERROR(environment::mirror_by_name({"hip_r", "knee_l", "knee_r"}),
               "hip_r: its mirror image 'hip_l'");
}

}  // namespace
}  // namespace stride
