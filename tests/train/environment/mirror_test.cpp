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

TEST(RightLegAhead, MirrorsWhatHasItsLeftHipFlexedFurther) {
  const auto symmetry = environment::right_leg_ahead(
      {"knee_r", "hip_flexion_l", "hip_flexion_r", "knee_l"}, {"push_l", "push_r"});
  Eigen::VectorXd x(4), seen(4);
  x << 1, 0.5, 0.2, 3;
  EXPECT_TRUE(symmetry.mirrors(x));
  symmetry.features.apply(x, seen);
  EXPECT_EQ(seen, (Eigen::VectorXd(4) << 3, 0.2, 0.5, 1).finished());
  EXPECT_FALSE(symmetry.mirrors(seen));
  x[1] = x[2];
  EXPECT_FALSE(symmetry.mirrors(x)) << "standing is seen as it is";
  EXPECT_ERROR(environment::right_leg_ahead({"x"}, {"push_l", "push_r"}), "hip_flexion_r");
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
