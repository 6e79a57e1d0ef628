#include "train/simulation/laws/limit.h"

#include <gtest/gtest.h>

#include "tests/train/reference.h"

namespace stride {
namespace {

TEST(LimitForce, IsOpenSims) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  const Reference r("limit_torque.csv");
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    for (const osim::CoordinateLimit& limit : model.limits) {
      if (limit.name != r.text(i, "force")) continue;
      const double torque = laws::limit_force(laws::limit_law(limit, true),
                                              r.number(i, "angle_rad"), r.number(i, "speed_rad_s"));
      // Angles have twelve digits: 1e-12 · 1146 N·m/rad.
      ASSERT_TRUE(close(torque, r.number(i, "torque_Nm"), 1e-11, 1e-8)) << i;
    }
  }
}

}  // namespace
}  // namespace stride
