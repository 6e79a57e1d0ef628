#include "train/simulation/laws/contact.h"

#include <gtest/gtest.h>

#include "tests/train/reference.h"

namespace stride {
namespace {

struct Force {
  double x = 0, y = 0;
};

class ContactLaws : public ::testing::Test {
 protected:
  ContactLaws() : law_(laws::contact_law(model_.contacts[0])) {}

  /// Of the heel or the toe sphere in a row of contact_foot*.csv.
  Force on(const Reference& r, std::size_t i, const std::string& part) const {
    const double depth = r.number(i, part + "_depth_m"), omega = r.number(i, "omega_z_rad_s");
    // The point of contact lies half-way in depth, below the centre.
    const double below = kRadius - depth / 2;
    const double vx = r.number(i, part + "_vx_m_s") + omega * below;
    const double normal = laws::normal_force(law_, kRadius, depth, -r.number(i, part + "_vy_m_s"));
    if (normal <= 0) return {};
    return {-std::copysign(laws::friction_force(law_, normal, std::abs(vx)), vx), normal};
  }

  static constexpr double kRadius = 0.05;
  osim::Model model_ = osim::load_osim(osim::default_model_file());
  laws::ContactLaw law_;
};

TEST_F(ContactLaws, FeetArePushedAsBySimbodyWithEveryContact) {
  const Reference r("contact_foot_continue.csv");
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    const Force heel = on(r, i, "heel"), toe = on(r, i, "toe");
    // Depths have 12 digits of a position: 5e-14 m, 1e-10 relative at a depth of a millimetre.
    ASSERT_TRUE(close(heel.y + toe.y, r.number(i, "GRF_y_N"), 1e-9, 1e-9)) << i;
    ASSERT_TRUE(close(heel.x + toe.x, r.number(i, "GRF_x_N"), 1e-9, 1e-9)) << i;
  }
}

TEST_F(ContactLaws, FeetArePushedAsBySimbodyWithContactsDropped) {
  const Reference r("contact_foot.csv");
  int dropped = 0;
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    Force heel = on(r, i, "heel"), toe = on(r, i, "toe");
    const bool heel_first = laws::first_sphere_is_swept_first(
        {r.number(i, "heel_cx_m"), r.number(i, "heel_cy_m"), 0.091}, kRadius,
        {r.number(i, "toe_cx_m"), r.number(i, "toe_cy_m"), 0.0925}, kRadius);
    const std::string first = heel_first ? "heel" : "toe";
    Force& second = heel_first ? toe : heel;
    const bool pulls = (heel_first ? heel : toe).y == 0 && r.number(i, first + "_depth_m") > 0;
    if (pulls && second.y > 0) ++dropped;
    if (pulls) second = {};
    ASSERT_TRUE(close(heel.y + toe.y, r.number(i, "GRF_y_N"), 1e-9, 1e-9)) << i;
    ASSERT_TRUE(close(heel.x + toe.x, r.number(i, "GRF_x_N"), 1e-9, 1e-9)) << i;
  }
  EXPECT_GE(dropped, 5);
}

TEST_F(ContactLaws, ObstaclesPushAsBySimbodyWithTheirNominalRadius) {
  const Reference r("contact_obstacle.csv");
  const double radius =
      laws::kNominalObstacleRadius_m * kRadius / (laws::kNominalObstacleRadius_m + kRadius);
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    const double distance = r.number(i, "dist3d_m");
    const double force =
        laws::normal_force(laws::obstacle_law(laws::kNominalObstacleRadius_m), radius,
                           laws::kNominalObstacleRadius_m + kRadius - distance, 0);
    const double x = (r.number(i, "toe_cx_m") - r.number(i, "obst_x_m")) / distance;
    const double z = r.number(i, "toe_cz_m") / distance;
    ASSERT_TRUE(close(force * x, r.number(i, "foot_r_block_Fx_N"), 1e-9, 1e-7)) << i;
    ASSERT_TRUE(close(force * z, r.number(i, "foot_r_block_Fz_N"), 1e-9, 1e-7)) << i;
  }
}

}  // namespace
}  // namespace stride
