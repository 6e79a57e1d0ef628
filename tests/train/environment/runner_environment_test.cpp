#include "train/environment/runner_environment.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

#include "tests/support/throws.h"
#include "tests/train/engines.h"
#include "tests/train/rollout.h"

namespace stride {
namespace {

Eigen::VectorXd action_of(const simulation::Excitations& excitations) {
  return Eigen::Map<const Eigen::VectorXd>(excitations.data(), simulation::kMuscles);
}

class Runner : public EachEngine {
 protected:
  environment::RunnerOptions options() const {
    environment::RunnerOptions options;
    options.engine = GetParam();
    return options;
  }
  double element(const environment::RunnerEnvironment& environment,
                 const Eigen::VectorXd& observation, const std::string& name) const {
    const auto& names = environment.spec().observation_names;
    const auto at = std::find(names.begin(), names.end(), name);
    EXPECT_NE(at, names.end()) << name;
    return observation[at - names.begin()];
  }
};
INSTANTIATE_FOR_EACH_ENGINE(Runner);

TEST(RunnerObservation, HasOneNameAnElement) {
  const std::vector<std::string>& names = competition::Sensors::names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_EQ(names.size(), 89u);
  EXPECT_EQ(names[18], "com_x");
  EXPECT_EQ(names[36], "strength_psoas_l");
  EXPECT_EQ(names[40], "obstacle_radius");
}

// Every element of the competition's observation and its reward, against OpenSim driven as the
// competition drove it. Columns `true_*` are the observation without its staleness.
TEST_P(Runner, UnderNips2017ObservesAndRewardsAsTheCompetitionDid) {
  for (const char* scenario : {"all005", "difficulty2_envseed1_random_seed1"}) {
    const Reference recorded(std::string("rollout_competition_") + scenario + ".csv");
    environment::RunnerOptions under = options();
    under.rules = competition::Rules::nips2017;
    under.difficulty = scenario[0] == 'd' ? 2 : 0;
    under.accuracy = 1e-7;
    under.late_positions = false;
    environment::RunnerEnvironment environment(model_, under);
    Eigen::VectorXd observation = environment.reset(1);
    const auto excitations = recorded_excitations(scenario[0] == 'd' ? "random_seed1" : scenario);
    std::vector<std::string> columns(competition::Sensors::kCompetition);
    for (const auto& [column, index] : recorded.columns)
      if (index >= 1 && index <= competition::Sensors::kCompetition) columns[index - 1] = column;
    double reward = 0;
    std::size_t row = 0;
    for (int step = 0; row < recorded.rows.size(); ++step) {
      if (std::abs(recorded.number(row, "t_s") - 0.01 * step) < 1e-9) {
        for (int i = 0; i < competition::Sensors::kCompetition; ++i) {
          const bool speed = columns[i].find("vel") != std::string::npos ||
                             columns[i].find("_v") != std::string::npos;
          EXPECT_NEAR(observation[i], recorded.number(row, columns[i]), speed ? 1e-3 : 1e-4)
              << scenario << ": " << columns[i] << " at step " << step;
        }
        EXPECT_NEAR(reward, recorded.number(row, "reward"), 1e-5) << scenario << ", step " << step;
        ++row;
      }
      if (step == 100) break;
      const environment::Step& done = environment.step(action_of(excitations[step]));
      observation = done.observation;
      reward = done.reward;
      ASSERT_FALSE(done.failed);
    }
    EXPECT_EQ(row, recorded.rows.size());
  }
}

TEST_P(Runner, RepeatsItselfBitByBit) {
  environment::RunnerOptions same = options();
  same.difficulty = 2;
  environment::RunnerEnvironment one(model_, same), two(model_, same);
  two.reset(5);
  for (int i = 0; i < 20; ++i) two.step(Eigen::VectorXd::Constant(simulation::kMuscles, 0.3));
  one.reset(9);
  two.reset(9);
  EXPECT_EQ(two.tally().abandoned, 1);
  std::mt19937_64 random(1);
  for (int i = 0; i < 50; ++i) {
    Eigen::VectorXd action(simulation::kMuscles);
    for (double& each : action) each = static_cast<double>(random() >> 11) * 0x1p-53;
    const environment::Step &a = one.step(action), &b = two.step(action);
    ASSERT_EQ(a.observation, b.observation) << "step " << i;
    ASSERT_EQ(a.reward, b.reward);
  }
}

TEST_P(Runner, FallEndsTheEpisodeAndTheTimeLimitCutsIt) {
  environment::RunnerOptions brief = options();
  brief.max_steps = 10;
  environment::RunnerEnvironment environment(model_, brief);
  environment.reset(0);
  for (int i = 1; i <= 10; ++i) {
    const environment::Step& step =
        environment.step(Eigen::VectorXd::Constant(simulation::kMuscles, 0.05));
    EXPECT_FALSE(step.terminated);
    EXPECT_EQ(step.truncated, i == 10);
  }
  EXPECT_EQ(environment.tally().time_limits, 1);

  environment::RunnerEnvironment falling(model_, options());
  falling.reset(0);
  const auto excitations = recorded_excitations("onehot_glut_max_r");
  int steps = 0;
  while (!falling.step(action_of(excitations[0])).terminated) ASSERT_LT(++steps, 100);
  EXPECT_EQ(steps + 1, 56);  // OpenSim: done at 0.56 s
  EXPECT_EQ(falling.tally().falls, 1);
  EXPECT_EQ(falling.tally().failures, 0);
  EXPECT_LT(falling.pose().pelvis_height_m(), competition::kFallHeight_m);
}

TEST_P(Runner, WhatCannotBeIntegratedIsAFallThatIsCounted) {
  environment::RunnerEnvironment environment(model_, options());
  environment.reset(0);
  Eigen::VectorXd action = Eigen::VectorXd::Zero(simulation::kMuscles);
  action[4] = std::nan("");
  const environment::Step& step = environment.step(action);
  EXPECT_TRUE(step.terminated);
  EXPECT_TRUE(step.failed);
  EXPECT_FALSE(step.truncated);
  EXPECT_TRUE(step.observation.allFinite());
  EXPECT_EQ(environment.tally().failures, 1);
  environment.reset(1);
  EXPECT_FALSE(environment.step(Eigen::VectorXd::Zero(simulation::kMuscles)).failed);
}

TEST_P(Runner, AStateBeyondReasonIsAFailureAndNotAnException) {
  const auto engine = this->engine();
  simulation::RunnerState state = simulation::default_state(model_);
  state.u[simulation::kKneeRight] = 1e200;
  engine->set_state(state);
  EXPECT_FALSE(engine->advance({}, 0.01).ok);
  state.u[simulation::kKneeRight] = std::numeric_limits<double>::quiet_NaN();
  engine->set_state(state);
  EXPECT_FALSE(engine->advance({}, 0.01).ok);
  simulation::EngineOptions few;
  few.max_evaluations = 20;
  few.accuracy = 1e-9;
  const auto hurried = this->engine(few);
  hurried->set_state(simulation::default_state(model_));
  EXPECT_FALSE(hurried->advance({}, 0.01).ok);
}

TEST_P(Runner, ActionsAreClipped) {
  environment::RunnerEnvironment one(model_, options()), two(model_, options());
  one.reset(0), two.reset(0);
  const environment::Step& a = one.step(Eigen::VectorXd::Constant(simulation::kMuscles, 7));
  const environment::Step& b = two.step(Eigen::VectorXd::Constant(simulation::kMuscles, 1));
  EXPECT_EQ(a.observation, b.observation);
}

TEST_P(Runner, ObservesTheNextObstacleFromThePelvis) {
  environment::RunnerOptions rough = options();
  rough.difficulty = 1;
  environment::RunnerEnvironment environment(model_, rough);
  const Eigen::VectorXd& observation = environment.reset(3);
  const simulation::Obstacle& first = environment.scene().obstacles[0];
  EXPECT_EQ(element(environment, observation, "obstacle_x"), first.x_m);
  EXPECT_EQ(element(environment, observation, "obstacle_y"), first.y_m);
  EXPECT_EQ(element(environment, observation, "obstacle_radius"), first.radius_m);

  const competition::Scene scene = environment.scene();
  const double behind = first.x_m + first.radius_m;
  EXPECT_NEAR(competition::next_obstacle(scene, behind - 1e-6).x_m, -first.radius_m, 1e-5);
  EXPECT_EQ(competition::next_obstacle(scene, behind + 1e-6).radius_m, scene.obstacles[1].radius_m);
  EXPECT_EQ(competition::next_obstacle(scene, 50).x_m, 100);
}

TEST_P(Runner, StartsOnAReferenceMotionWithItsSpeeds) {
  environment::RunnerOptions from = options();
  from.reference.emplace();
  for (int i = 0; i < 12; ++i) {
    CalibratedSample sample;
    sample.time_s = 0.02 * i;
    sample.phase = i / 12.0;
    sample.coordinates = {-0.1, 3 * sample.time_s,        0.9, 0.2 + sample.time_s, -0.4, 0.1,
                          -0.2, -0.8 + 2 * sample.time_s, 0};
    from.reference->samples.push_back(sample);
  }
  environment::RunnerEnvironment environment(model_, from);
  std::set<double> phases;
  for (int seed = 0; seed < 20; ++seed) {
    const Eigen::VectorXd& observation = environment.reset(seed);
    phases.insert(environment.initial_phase());
    EXPECT_NEAR(element(environment, observation, "pelvis_tx_u"), 3, 1e-12);
    EXPECT_NEAR(element(environment, observation, "hip_flexion_r_u"), 1, 1e-12);
    EXPECT_NEAR(element(environment, observation, "hip_flexion_r"),
                0.2 + 0.24 * environment.initial_phase(), 1e-12);
    EXPECT_EQ(element(environment, observation, "pelvis_tx"), 0);
    EXPECT_EQ(environment.distance_m(), 0);
    EXPECT_FALSE(environment.step(Eigen::VectorXd::Zero(simulation::kMuscles)).terminated);
  }
  EXPECT_GT(phases.size(), 5u);
}

TEST_P(Runner, AKneeThatBendsBackwardCostsAndOneThatBendsForwardDoesNot) {
  environment::RunnerOptions free = options();
  free.reference.emplace();
  CalibratedSample sample;
  sample.coordinates = {0,   0,    0.95, 0.2, 0.3,
                        0.1, -0.2, -0.8, 0};  // right knee back, left one bent
  for (int i = 0; i < 3; ++i) {
    sample.time_s = 0.01 * i;
    free.reference->samples.push_back(sample);
  }
  environment::RunnerOptions charged = free;
  charged.backward_knees = 4;
  environment::RunnerEnvironment a(model_, free), b(model_, charged);
  a.reset(0), b.reset(0);
  for (int i = 0; i < 5; ++i) {
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(simulation::kMuscles);
    const double without = a.step(rest).reward, with = b.step(rest).reward;
    const double knee_rad = a.engine().state().q[simulation::kKneeRight];
    EXPECT_GT(knee_rad, 0.05);
    EXPECT_LT(a.engine().state().q[simulation::kKneeLeft], 0);
    EXPECT_NEAR(without - with, 4 * 0.01 * knee_rad, 1e-15);
  }
}

TEST_P(Runner, WhereLegsMoveTogetherTheLeftOneIsGivenTheRightOnesExcitations) {
  environment::RunnerOptions of_jump = options();
  of_jump.task = task::task_of("jump", "movement");
  environment::RunnerEnvironment environment(model_, of_jump);
  environment.reset(0);
  Eigen::VectorXd action = Eigen::VectorXd::Zero(simulation::kMuscles);
  action.head(simulation::kMusclesOfLeg).setConstant(0.7);
  for (int i = 0; i < 20; ++i) environment.step(action);
  const simulation::RunnerState& state = environment.engine().state();
  for (int i = 0; i < simulation::kMusclesOfLeg; ++i)
    EXPECT_NEAR(state.activation[i], state.activation[simulation::kMusclesOfLeg + i], 1e-9);
  EXPECT_NEAR(state.q[simulation::kHipRight], state.q[simulation::kHipLeft], 1e-6);
}

TEST_P(Runner, PoseIsRelativeToThePelvis) {
  environment::RunnerEnvironment environment(model_, options());
  const Eigen::VectorXd observation = environment.reset(0);
  const Pose pose = environment.pose();
  EXPECT_EQ(pose.pelvis_height_m(), 0.91);
  EXPECT_NEAR(pose[PosePart::foot_r].x(), element(environment, observation, "talus_r_x"), 1e-15);
  EXPECT_NEAR(pose[PosePart::foot_r].y(), element(environment, observation, "talus_r_y") - 0.91,
              1e-15);
  EXPECT_NEAR(pose[PosePart::knee_l].y(), element(environment, observation, "tibia_l_y") - 0.91,
              1e-15);
}

/// Against the central difference of the pose over two steps of 0.01 s, in the air.
TEST_P(Runner, PoseVelocityIsTheDerivativeOfThePose) {
  environment::RunnerEnvironment environment(model_, options());
  environment.reset(0);
  const Eigen::VectorXd action = Eigen::VectorXd::Constant(simulation::kMuscles, 0.3);
  for (int i = 0; i < 30; ++i) environment.step(action);
  const Pose before = environment.pose();
  environment.step(action);
  const Pose velocity = environment.pose_velocity();
  environment.step(action);
  const Pose after = environment.pose();
  for (std::size_t i = 0; i < kPoseNumbers; ++i)
    EXPECT_NEAR(velocity.m[i], (after.m[i] - before.m[i]) / 0.02,
                0.02 + 0.02 * std::abs(velocity.m[i]))
        << i;
  EXPECT_GT(velocity.row().cwiseAbs().maxCoeff(), 0.1);
}

TEST(RunnerOptionsAre, CheckedByName) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  environment::RunnerOptions options;
  options.difficulty = 5;
  EXPECT_ERROR(environment::RunnerEnvironment(model, options), "difficulty = 5");
  options = {};
  options.accuracy = 0;
  EXPECT_ERROR(environment::RunnerEnvironment(model, options), "accuracy = 0: must be in (0, 0.1]");
  options = {};
  options.foot = "heel";
  EXPECT_ERROR(environment::RunnerEnvironment(model, options),
               "foot \"heel\": must be ankle or toe");
  options = {};
  options.backward_knees = -1;
  EXPECT_ERROR(environment::RunnerEnvironment(model, options), "backward_knees = -1: must be >= 0");
  options = {};
  options.reference.emplace();
  options.reference->source = "run.mp4";
  options.reference->samples.resize(2);
  EXPECT_ERROR(environment::RunnerEnvironment(model, options), "reference run.mp4: has 2 samples");
  options.reference->samples.resize(3);
  options.reference->samples[1].coordinates[4] = std::nan("");
  EXPECT_ERROR(environment::RunnerEnvironment(model, options), "a coordinate is not a number");
}

}  // namespace
}  // namespace stride
