#include "train/simulation/competition/rules.h"

#include <gtest/gtest.h>

#include "tests/support/throws.h"
#include "tests/train/engines.h"
#include "tests/train/reference.h"

namespace stride {
namespace {

// What RunEnv.generate_env drew with numpy, seeds 0 to 49, difficulty 0, 1 and 2.
TEST(Scene, IsTheCompetitionsDrawOfTheSameSeed) {
  const Reference recorded("env_descs.csv");
  ASSERT_EQ(recorded.rows.size(), 150u);
  for (std::size_t row = 0; row < recorded.rows.size(); ++row) {
    const auto seed = static_cast<std::uint64_t>(recorded.number(row, "seed"));
    const int difficulty = static_cast<int>(recorded.number(row, "difficulty"));
    const competition::Scene scene = competition::draw_scene(seed, difficulty, 3);
    EXPECT_DOUBLE_EQ(scene.strength_r, recorded.number(row, "strength_idx3"));
    EXPECT_DOUBLE_EQ(scene.strength_l, recorded.number(row, "strength_idx11"));
    ASSERT_EQ(scene.obstacles.size(), recorded.number(row, "n_obst"));
    for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
      EXPECT_DOUBLE_EQ(scene.obstacles[i].x_m, recorded.number(row, fmt::format("x{}_m", i)));
      EXPECT_DOUBLE_EQ(scene.obstacles[i].y_m, recorded.number(row, fmt::format("y{}_m", i)));
      EXPECT_DOUBLE_EQ(scene.obstacles[i].radius_m, recorded.number(row, fmt::format("r{}_m", i)));
    }
  }
}

TEST(Scene, FurtherObstaclesLieBeyondFiveMetresInOrder) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const competition::Scene scene = competition::draw_scene(seed, 2, 20);
    ASSERT_EQ(scene.obstacles.size(), 20u);
    for (int i = 0; i < 20; ++i) {
      const simulation::Obstacle& each = scene.obstacles[i];
      EXPECT_GE(each.radius_m, 0.05);
      if (i < 3)
        EXPECT_TRUE(each.x_m >= 1 && each.x_m <= 5);
      else
        EXPECT_TRUE(each.x_m >= 7 + 2 * (i - 3) && each.x_m <= 9 + 4 * (i - 3)) << each.x_m;
      EXPECT_GE(each.y_m, (i < 3 ? -0.25 : -0.05) * each.radius_m);
      EXPECT_LE(each.y_m, 0.25 * each.radius_m);
    }
    EXPECT_GE(std::min(scene.strength_l, scene.strength_r), 0.5);
  }
}

TEST(Scene, LargeSeedsDifferInTheirUpperHalf) {
  const double a = competition::draw_scene(7, 1, 3).obstacles[0].x_m;
  EXPECT_NE(a, competition::draw_scene(7 + (1ull << 40), 1, 3).obstacles[0].x_m);
  EXPECT_EQ(a, competition::draw_scene(7, 2, 3).obstacles[0].x_m);
}

TEST(Scene, RefusesWhatIsOutOfRange) {
  EXPECT_ERROR(competition::draw_scene(1, 3, 3), "difficulty = 3: must be 0 (flat)");
  EXPECT_ERROR(competition::draw_scene(1, 1, 21), "max_obstacles = 21: must be 0 to 20");
  EXPECT_ERROR(competition::rules_named("nips2018"), "rules \"nips2018\"");
}

using EngineUnderRules = EachEngine;
INSTANTIATE_FOR_EACH_ENGINE(EngineUnderRules);

TEST_P(EngineUnderRules, LeftStrengthIsOfThePsoasOrOfTheGluteusMaximus) {
  competition::Scene scene;
  scene.strength_r = 0.5, scene.strength_l = 0.25;
  const auto forces = [&](competition::Rules rules, const competition::Scene& with) {
    const auto engine = this->engine();
    competition::arrange(with, rules, 3, *engine);
    competition::set_initial_state(competition::Rules::nips2017, *engine);
    return engine->kinematics().tendon_force_N;
  };
  const auto full = forces(competition::Rules::clean, {});
  const auto clean = forces(competition::Rules::clean, scene),
             competition = forces(competition::Rules::nips2017, scene);
  EXPECT_NEAR(full[11], 147037.704401, 1e-4);  // of OpenSim, as the competition starts (O1)
  EXPECT_NEAR(full[12], 21479.1427963, 1e-4);
  EXPECT_DOUBLE_EQ(clean[3], 0.5 * full[3]);
  EXPECT_DOUBLE_EQ(clean[11], full[11]);
  EXPECT_DOUBLE_EQ(clean[12], 0.25 * full[12]);
  EXPECT_DOUBLE_EQ(competition[3], 0.5 * full[3]);
  EXPECT_DOUBLE_EQ(competition[11], 0.25 * full[11]);
  EXPECT_DOUBLE_EQ(competition[12], full[12]);
}

// Forces of an obstacle on the right foot, as OpenSim recorded them for its spheres of 0.1 m (O4):
// here from the change of the runner's acceleration, as mass times that of the centre of mass.
TEST_P(EngineUnderRules, ObstaclesPushAsTheCompetitionsDid) {
  const Reference recorded("contact_obstacle.csv");
  simulation::EngineOptions options;
  options.nominal_obstacles = true;
  simulation::RunnerState state = simulation::default_state(model_);
  int touching = 0;
  for (std::size_t row = 0; row < recorded.rows.size(); ++row) {
    if (recorded.text(row, "strength_note") != "r_toe vs obstacle 0") continue;
    const auto engine = this->engine(options);
    // Put the right toe's sphere, alone near the obstacle, where it was.
    engine->set_state(state);
    const auto frame = engine->kinematics().bodies[model_.body("toes_r")];
    const double toe_x =
        frame.position.x + 0.03 * std::cos(frame.angle_rad) - 0.04 * std::sin(frame.angle_rad);
    const double toe_y =
        frame.position.y + 0.03 * std::sin(frame.angle_rad) + 0.04 * std::cos(frame.angle_rad);
    simulation::RunnerState lifted = state;
    lifted.q[2] += 1;   // off the ground
    lifted.q[6] = 1.5;  // the left leg out of the way
    engine->set_state(lifted);
    const auto force = [&] {
      const auto udot = engine->derivative({}).udot;
      const auto mass = engine->mass_matrix();
      simulation::Planar sum;
      for (int j = 0; j < simulation::kCoordinates; ++j) {
        sum.x += mass[1 * simulation::kCoordinates + j] * udot[j];
        sum.y += mass[2 * simulation::kCoordinates + j] * udot[j];
      }
      return sum;
    };
    const simulation::Planar without = force();
    const double radius = recorded.number(row, "obst_r_requested_m");
    engine->set_obstacles(
        {{toe_x + recorded.number(row, "obst_x_m") - recorded.number(row, "toe_cx_m"),
          1 + toe_y + recorded.number(row, "obst_y_m") - recorded.number(row, "toe_cy_m"),
          radius}});
    const simulation::Planar with = force();
    EXPECT_TRUE(close(with.x - without.x, recorded.number(row, "foot_r_block_Fx_N"), 1e-8, 1e-4))
        << "row " << row;
    EXPECT_TRUE(close(with.y - without.y, recorded.number(row, "foot_r_block_Fy_N"), 1e-8, 1e-4))
        << "row " << row;
    touching += recorded.number(row, "foot_r_block_Fx_N") != 0;
  }
  EXPECT_GE(touching, 5);
}

TEST_P(EngineUnderRules, ObstaclesHaveTheirOwnSizeWhenClean) {
  // A toe 0.14 m from the obstacle's centre: within reach of a ball of 0.1 m, not of 0.05 m, and
  // pushed harder by a ball of 0.12 m.
  simulation::RunnerState state = simulation::default_state(model_);
  state.q[2] += 1;
  const auto acceleration = [&](double radius, bool nominal) {
    simulation::EngineOptions options;
    options.nominal_obstacles = nominal;
    const auto engine = this->engine(options);
    engine->set_state(state);
    engine->set_obstacles({{0.12, 1.0, radius}});
    return engine->derivative({}).udot[1];
  };
  const double untouched = acceleration(0.01, false);
  EXPECT_EQ(acceleration(0.05, false), untouched);
  EXPECT_LT(acceleration(0.12, false), untouched);
  EXPECT_LT(acceleration(0.05, true), untouched);
  EXPECT_EQ(acceleration(0.05, true), acceleration(0.12, true));
}

}  // namespace
}  // namespace stride
