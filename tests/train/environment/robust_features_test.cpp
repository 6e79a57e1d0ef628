#include "train/environment/robust_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "train/environment/mirror.h"
#include "train/environment/observation.h"
#include "train/environment/runner_environment.h"

namespace stride::environment {
namespace {

RunnerOptions of_the_competition(bool late) {
  RunnerOptions options;
  options.rules = competition::Rules::nips2017;
  options.difficulty = 2;
  options.max_obstacles = 10;
  options.late_positions = late;
  return options;
}

Eigen::VectorXd excitations(int step) {
  Eigen::VectorXd a(18);
  for (int i = 0; i < 18; ++i) a[i] = 0.5 + 0.5 * std::sin(0.1 * step + 3 * i);
  return a;
}

class Robust : public ::testing::Test {
 protected:
  double of(const Eigen::VectorXd& features, const std::string& name) {
    const auto found = std::ranges::find(features_.names(), name);
    EXPECT_NE(found, features_.names().end()) << name;
    return features[found - features_.names().begin()];
  }
  Eigen::VectorXd write(const Eigen::VectorXd& observation) {
    Eigen::VectorXd features(static_cast<Eigen::Index>(features_.names().size()));
    features_.read(observation, features.data());
    return features;
  }

  osim::Model model_ = osim::load_osim(osim::default_model_file());
  RobustFeatures features_{model_, competition::Rules::nips2017};
};

TEST_F(Robust, FeaturesHaveNamesOfTheirOwnThatMirror) {
  const auto& names = features_.names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_NO_THROW(mirror_by_name(names));
}

TEST_F(Robust, FeetAreWhereTheEnginePutsThemHoweverLateTheyAreObserved) {
  RunnerEnvironment exact(model_, of_the_competition(false)),
      late(model_, of_the_competition(true));
  features_.start();
  Eigen::VectorXd from_exact = write(exact.reset(4)), from_late = write(late.reset(4));
  int differ = 0;
  for (int step = 0; step < 60; ++step) {
    const auto& body = exact.kinematics().bodies;
    const double x = exact.engine().state().q[1];
    for (const auto& [name, origin] :
         {std::pair{"ankle_r", "talus_r"}, std::pair{"ankle_l", "talus_l"},
          std::pair{"toe_r", "toes_r"}, std::pair{"toe_l", "toes_l"}}) {
      const simulation::PlanarVector at =
          body[static_cast<std::size_t>(model_.body(origin))].position;
      EXPECT_NEAR(of(from_exact, std::string(name) + "_x"), at.x - x, 1e-9);
      EXPECT_NEAR(of(from_exact, std::string(name) + "_y"), at.y, 1e-9);
    }
    EXPECT_EQ(from_exact, from_late);
    const Eigen::VectorXd action = excitations(step);
    const Eigen::VectorXd a = exact.step(action).observation, b = late.step(action).observation;
    differ += a.head(41) != b.head(41);
    from_exact = write(a), from_late = write(b);
  }
  EXPECT_GT(differ, 3) << "no position was late";
}

TEST_F(Robust, AnObstacleStaysInSightOfTheFootThatHasStillToPassIt) {
  Eigen::VectorXd o = Eigen::VectorXd::Zero(41);
  const auto stand = [&](double x, double obstacle_x) {  // hip angles put the feet apart
    o[1] = x, o[2] = 0.9, o[6] = 0.5, o[9] = -0.5;
    o[38] = obstacle_x >= 50 ? 100 : obstacle_x - x;
    o[39] = 0.02, o[40] = 0.3;  // as large as 0.1 m when it is met
  };
  features_.start();
  stand(0, 100);
  const Eigen::VectorXd none = write(o);
  EXPECT_EQ(of(none, "obstacle_near_x"), 3);
  EXPECT_EQ(of(none, "obstacle_top_y"), 0);
  EXPECT_EQ(of(none, "toe_r_to_near_side"), 3);
  stand(0, 2);
  const Eigen::VectorXd ahead = write(o);
  EXPECT_NEAR(of(ahead, "obstacle_near_x"), 1.9, 1e-12);
  EXPECT_NEAR(of(ahead, "obstacle_top_y"), 0.12, 1e-12);
  EXPECT_NEAR(of(ahead, "toe_r_to_near_side"), 1.9 - of(ahead, "toe_r_x"), 1e-12);
  EXPECT_NEAR(of(ahead, "ankle_l_to_far_side"), 2.1 - of(ahead, "ankle_l_x"), 1e-12);
  EXPECT_NEAR(of(ahead, "toe_l_above_top"), of(ahead, "toe_l_y") - 0.12, 1e-12);
  stand(2.2, 100);  // the pelvis and the right foot are past it
  const Eigen::VectorXd passing = write(o);
  ASSERT_GT(of(passing, "ankle_r_x"), 0);
  ASSERT_LT(of(passing, "ankle_l_x"), -0.1);
  EXPECT_EQ(of(passing, "obstacle_near_x"), 3);
  EXPECT_EQ(of(passing, "toe_r_to_near_side"), 3);
  EXPECT_NEAR(of(passing, "ankle_l_to_far_side"), -0.1 - of(passing, "ankle_l_x"), 1e-12);
  features_.start();
  EXPECT_EQ(of(write(o), "ankle_l_to_far_side"), 3) << "of an earlier episode";
}

/// The activations that the agent sees follow from its own excitations: OpenSim's equation
/// (Thelen 2003) from the default 0.05, by Euler's method in steps of 1e-5 s.
TEST_F(Robust, ActivationsNeedNoSensor) {
  RunnerEnvironment environment(model_, of_the_competition(true));
  environment.reset(4);
  Eigen::VectorXd copy = Eigen::VectorXd::Constant(18, 0.05);
  for (int step = 0; step < 40; ++step) {
    const Eigen::VectorXd u = excitations(step);
    for (int i = 0; i < 1000; ++i)
      for (int k = 0; k < 18; ++k) {
        const double a = std::max(copy[k], 0.01), f = 0.5 + 1.5 * a;
        copy[k] += 1e-5 * (u[k] - a) / (u[k] > a ? 0.010 * f : 0.040 / f);
      }
    const Eigen::VectorXd observed = environment.step(u).observation.segment(
        static_cast<Eigen::Index>(competition::Sensors::names().size()) - 18, 18);
    EXPECT_LT((observed - copy).cwiseAbs().maxCoeff(), 2e-3) << step;
  }
}

}  // namespace
}  // namespace stride::environment
