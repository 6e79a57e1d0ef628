#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "tests/train/engines.h"
#include "train/environment/mirror.h"
#include "train/environment/runner_environment.h"

// Conservation laws and symmetries, whatever the model.

namespace stride {
namespace {

using Mechanics = EachEngine;
INSTANTIATE_FOR_EACH_ENGINE(Mechanics);

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

simulation::RunnerState random_state(const osim::Model& model, std::mt19937_64& random,
                                     double height) {
  simulation::RunnerState state = simulation::default_state(model);
  state.q[simulation::kPelvisTilt] = uniform(random, -0.5, 0.5);
  state.q[simulation::kPelvisY] = height + uniform(random, -0.05, 0.05);
  for (int leg : {3, 6}) {
    state.q[leg] = uniform(random, -1, 1.5);
    state.q[leg + 1] = uniform(random, -2, 0.3);
    state.q[leg + 2] = uniform(random, -0.9, 0.6);
  }
  for (double& u : state.u) u = uniform(random, -3, 3);
  for (double& a : state.activation) a = uniform(random, 0.01, 1);
  return state;
}

struct Conserved {
  double energy_J = 0, momentum_x = 0, momentum_y = 0, angular = 0;  // about the centre of mass
};

Conserved conserved(simulation::Engine& engine) {
  const auto mass = engine.mass_matrix();
  const simulation::RunnerKinematics k = engine.kinematics();
  const simulation::RunnerState& state = engine.state();
  double p[3] = {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < simulation::kCoordinates; ++j)
      p[i] += mass[i * simulation::kCoordinates + j] * state.u[j];
  // The tilt's momentum is the angular one about the pelvis.
  const double about_pelvis = (k.com.x - state.q[simulation::kPelvisX]) * p[2] -
                              (k.com.y - state.q[simulation::kPelvisY]) * p[1];
  return {k.energy_J, p[1], p[2], p[0] - about_pelvis};
}

TEST_P(Mechanics, PassiveSkeletonKeepsEnergyAndMomentum) {
  constexpr double kMass = 79.6646, kGravity = 9.80665, kTime = 0.3;
  std::mt19937_64 random(3);
  simulation::EngineOptions tight;
  tight.accuracy = 1e-9;
  for (int trial = 0; trial < 4; ++trial) {
    const auto engine = skeleton(tight);
    engine->set_state(random_state(model_, random, 2));
    const Conserved before = conserved(*engine);
    for (int i = 0; i < 30; ++i) ASSERT_TRUE(engine->advance({}, kTime / 30).ok);
    const Conserved after = conserved(*engine);
    EXPECT_NEAR(after.energy_J, before.energy_J, 1e-5);
    EXPECT_NEAR(after.momentum_x, before.momentum_x, 1e-6);
    EXPECT_NEAR(after.momentum_y, before.momentum_y - kMass * kGravity * kTime, 1e-6);
    EXPECT_NEAR(after.angular, before.angular, 1e-6);
  }
}

TEST_P(Mechanics, ContactAndMusclesAreInternalOrOfTheGround) {
  // The ground's reaction and gravity are all that moves the centre of mass.
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const auto engine = this->engine();
    engine->set_state(random_state(model_, random, 0.85));
    engine->equilibrate_fibers();
    const auto udot = engine->derivative({}).udot;
    const simulation::RunnerKinematics k = engine->kinematics();
    const double step = 1e-6;  // momentum's rate, along the motion
    simulation::RunnerState ahead = engine->state(), behind = ahead;
    for (int i = 0; i < simulation::kCoordinates; ++i) {
      ahead.q[i] += step * ahead.u[i], ahead.u[i] += step * udot[i];
      behind.q[i] -= step * behind.u[i], behind.u[i] -= step * udot[i];
    }
    engine->set_state(ahead);
    const Conserved a = conserved(*engine);
    engine->set_state(behind);
    const Conserved b = conserved(*engine);
    const simulation::PlanarVector foot_r = k.ground_reaction_N[0], foot_l = k.ground_reaction_N[1];
    EXPECT_NEAR((a.momentum_x - b.momentum_x) / (2 * step), foot_r.x + foot_l.x, 1e-2);
    EXPECT_NEAR((a.momentum_y - b.momentum_y) / (2 * step), foot_r.y + foot_l.y - 79.6646 * 9.80665,
                1e-2);
  }
}

TEST_P(Mechanics, MirrorOfAStepIsTheStepOfTheMirror) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 30; ++trial) {
    simulation::RunnerState state = random_state(model_, random, 0.9);
    simulation::Excitations excitations;
    for (double& each : excitations) each = uniform(random, 0, 1);
    const auto one = engine(), other = engine();
    one->set_state(state);
    one->equilibrate_fibers();
    other->set_state(simulation::mirrored(one->state()));
    const std::vector<simulation::Obstacle> obstacles{{0.1, 0, 0.1}};
    one->set_obstacles(obstacles), other->set_obstacles(obstacles);
    one->set_strength(3, 0.7), other->set_strength(12, 0.7);

    const simulation::RunnerDerivative a = one->derivative(excitations),
                                       b = other->derivative(simulation::mirrored(excitations));
    for (int i = 0; i < simulation::kCoordinates; ++i) {
      const int j = i < 3 ? i : i < 6 ? i + 3 : i - 3;
      EXPECT_TRUE(close(b.udot[j], a.udot[i], 1e-11, 1e-8));
    }
    ASSERT_TRUE(one->advance(excitations, 0.01).ok);
    ASSERT_TRUE(other->advance(simulation::mirrored(excitations), 0.01).ok);
    const simulation::RunnerState back = simulation::mirrored(other->state());
    for (int i = 0; i < simulation::kCoordinates; ++i) {
      EXPECT_NEAR(back.q[i], one->state().q[i], 1e-11) << "trial " << trial;
      EXPECT_NEAR(back.u[i], one->state().u[i], 1e-8) << "trial " << trial;
    }
    for (int i = 0; i < simulation::kMuscles; ++i) {
      EXPECT_NEAR(back.activation[i], one->state().activation[i], 1e-12);
      EXPECT_NEAR(back.fiber_length_m[i], one->state().fiber_length_m[i], 1e-11);
    }
  }
}

TEST_P(Mechanics, EnvironmentObservesTheMirrorByNames) {
  environment::RunnerOptions options;
  options.engine = GetParam();
  environment::RunnerEnvironment one(model_, options), other(model_, options);
  const environment::Mirror observations =
      environment::mirror_by_name(one.spec().observation_names);
  const environment::Mirror actions = environment::mirror_by_name(one.spec().action_names);
  one.reset(1), other.reset(1);
  std::mt19937_64 random(6);
  Eigen::VectorXd action(simulation::kMuscles), mirrored_action(simulation::kMuscles);
  Eigen::VectorXd expected(static_cast<Eigen::Index>(one.spec().observation_names.size()));
  for (int i = 0; i < 30; ++i) {
    for (double& each : action) each = uniform(random, 0, 1);
    actions.apply(action, mirrored_action);
    const environment::Step &a = one.step(action), &b = other.step(mirrored_action);
    observations.apply(a.observation, expected);
    EXPECT_LT((b.observation - expected).cwiseAbs().maxCoeff(), 1e-6) << "step " << i;
    EXPECT_NEAR(a.reward, b.reward, 1e-9);
    EXPECT_LT((one.pose().mirrored()[PosePart::foot_l] - other.pose()[PosePart::foot_l]).norm(),
              1e-9);
  }
}

}  // namespace
}  // namespace stride
