#include "train/task/task.h"

#include <gtest/gtest.h>

#include "calibrate/osim/model.h"
#include "extract/skeleton/movement.h"
#include "tests/support/throws.h"
#include "train/simulation/engine/runner_layout.h"

namespace stride::task {
namespace {

/// A runner whose body is moved by hand: pelvis, ankles and what the feet bear.
class Puppet {
 public:
  explicit Puppet(const std::string& task, double speed_m_s = 0, double slip = 0)
      : model_(osim::load_osim(osim::default_model_file())),
        task_(make_task({.movement = "", .name = task, .speed_m_s = speed_m_s, .slip = slip},
                        model_)),
        state_(simulation::default_state(model_)) {
    kinematics_.bodies.resize(model_.bodies.size());
    for (const osim::Body& body : model_.bodies) weight_N_ += 9.80665 * body.mass_kg;
    stand(true, true);
    kinematics_.com.y = 1;
    state_.q[simulation::kPelvisX] = 0;
    task_->start({state_, kinematics_, {}});
  }

  void stand(bool right, bool left) {
    kinematics_.ground_reaction_N = {{{0, right ? weight_N_ : 0}, {0, left ? weight_N_ : 0}}};
  }
  void put_ankles(double right_m, double left_m) {
    kinematics_.bodies[static_cast<std::size_t>(model_.body("talus_r"))].position.x = right_m;
    kinematics_.bodies[static_cast<std::size_t>(model_.body("talus_l"))].position.x = left_m;
  }
  void move_foot(const std::string& side, double heel_m_s, double toe_m_s) {
    kinematics_.bodies[static_cast<std::size_t>(model_.body("calcn_" + side))].velocity.x =
        heel_m_s;
    kinematics_.bodies[static_cast<std::size_t>(model_.body("toes_" + side))].velocity.x = toe_m_s;
  }
  /// So many steps, in each of which the pelvis moves by `dx_m`.
  End advance(int steps, double dx_m = 0) {
    Outcome outcome;
    for (int i = 0; i < steps && outcome.end == End::none; ++i) {
      state_.q[simulation::kPelvisX] += dx_m;
      outcome = task_->step({state_, kinematics_, {dx_m, 0}});
      reward_ += outcome.reward;
    }
    return outcome.end;
  }

  osim::Model model_;
  std::unique_ptr<Task> task_;
  simulation::RunnerState state_;
  simulation::RunnerKinematics kinematics_;
  double weight_N_ = 0, reward_ = 0;
};

TEST(Task, OfEveryMovementIsKnown) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  for (const Movement& each : movements())
    EXPECT_NE(make_task(task_of(each.name, "movement"), model), nullptr) << each.name;
  EXPECT_ERROR(make_task({.movement = "", .name = "fly"}, model),
               "task.name = fly: must be one of distance, speed, walk, long-jump, high-jump");
  EXPECT_ERROR(make_task({.movement = "", .name = "speed"}, model), "task.speed_m_s = 0");
}

TEST(Task, OfARunIsTheDistance) {
  Puppet puppet("distance");
  EXPECT_EQ(puppet.advance(100, 0.04), End::none);
  EXPECT_NEAR(puppet.task_->measure_m(), 4, 1e-9);
  EXPECT_NEAR(puppet.reward_, 4, 1e-9);
  puppet.state_.q[simulation::kPelvisY] = 0.6;
  EXPECT_EQ(puppet.advance(1), End::fall);
}

TEST(Task, OfASpeedRewardsThatSpeedMost) {
  const auto reward_at = [](double speed_m_s) {
    Puppet puppet("speed", 1.3);
    puppet.advance(100, 0.01 * speed_m_s);
    return puppet.reward_;
  };
  EXPECT_NEAR(reward_at(1.3), 1.3, 1e-9);
  EXPECT_NEAR(reward_at(0.8), 0.8, 1e-9);
  EXPECT_NEAR(reward_at(1.8), 0.8, 1e-9);
  EXPECT_LT(reward_at(3), 0);
}

TEST(Task, OfWalkingHasAFootOnTheGround) {
  Puppet walker("walk", 1.3);
  walker.advance(100, 0.013);
  EXPECT_NEAR(walker.task_->measure_m(), 1.3, 1e-9);
  Puppet runner("walk", 1.3);
  runner.advance(50, 0.013);
  runner.stand(false, false);
  runner.advance(50, 0.013);
  EXPECT_NEAR(runner.task_->measure_m(), 0, 1e-9);
}

TEST(Task, OfWalkingChargesFeetThatSlideButNotThoseThatRollOrSwing) {
  const auto cost_of = [](double heel_m_s, double toe_m_s, double weight_share) {
    Puppet puppet("walk", 1.3, 2);
    puppet.stand(true, true);
    puppet.kinematics_.ground_reaction_N[1].y = weight_share * puppet.weight_N_;
    puppet.move_foot("l", heel_m_s, toe_m_s);
    puppet.advance(100, 0.013);
    EXPECT_NEAR(puppet.task_->measure_m(), 1.3, 1e-9);
    return 1.3 - puppet.reward_;
  };
  EXPECT_NEAR(cost_of(1.5, 1.2, 0.5), 2 * 1.2, 1e-9) << "it slides";
  EXPECT_NEAR(cost_of(-0.5, -0.4, 0.5), 2 * 0.4, 1e-9) << "backwards";
  EXPECT_NEAR(cost_of(1.5, 1.2, 0.01), 2 * 1.2 * 0.2, 1e-5) << "it brushes the ground";
  EXPECT_NEAR(cost_of(1.5, 0, 0.5), 0, 1e-9) << "it rolls over the toe";
  EXPECT_NEAR(cost_of(0, 0.3, 0.5), 0, 1e-9) << "over the heel";
  EXPECT_NEAR(cost_of(1.5, 1.2, 0), 0, 1e-9) << "it swings";
}

TEST(Task, OfALongJumpMeasuresFromTheForemostToTheRearmostAnkle) {
  Puppet puppet("long-jump");
  puppet.put_ankles(0.1, 0);
  EXPECT_EQ(puppet.advance(50), End::none);
  puppet.stand(false, false);
  puppet.advance(30, 0.03);
  puppet.put_ankles(1.1, 1.0);
  puppet.stand(true, true);
  EXPECT_EQ(puppet.advance(49), End::none);
  EXPECT_EQ(puppet.task_->measure_m(), 0) << "not stood yet";
  EXPECT_EQ(puppet.advance(1), End::done);
  EXPECT_NEAR(puppet.task_->measure_m(), 0.9, 1e-9);
}

TEST(Task, OfAJumpIsNotDoneOnOneFoot) {
  Puppet puppet("long-jump");
  puppet.stand(false, false);
  puppet.advance(10, 0.03);
  puppet.put_ankles(0.2, 0.9);
  puppet.stand(true, false);
  EXPECT_EQ(puppet.advance(100), End::none);
  puppet.put_ankles(0.2, 0.4);
  puppet.stand(true, true);
  EXPECT_EQ(puppet.advance(60), End::done);
  EXPECT_NEAR(puppet.task_->measure_m(), 0.2, 1e-9);
}

TEST(Task, OfAJumpIsNothingWithoutALandingThatIsStood) {
  Puppet puppet("long-jump");
  puppet.stand(false, false);
  puppet.advance(30, 0.03);
  puppet.put_ankles(1, 1);
  puppet.stand(true, true);
  puppet.advance(20);
  puppet.state_.q[simulation::kPelvisY] = 0.4;
  EXPECT_EQ(puppet.advance(1), End::fall);
  EXPECT_EQ(puppet.task_->measure_m(), 0);
}

TEST(Task, OfManyHopsTheBestAloneIsPaid) {
  Puppet puppet("long-jump");
  for (int hop = 0; hop < 3; ++hop) {
    puppet.stand(false, false);
    puppet.advance(10, 0.01);  // 0.06 m of it after the first 0.04 s
    puppet.stand(true, true);
    puppet.advance(5);
  }
  EXPECT_NEAR(puppet.reward_, 0.06, 1e-9);
}

TEST(Task, OfAJumpAFallTakesTheFlightBack) {
  Puppet puppet("long-jump");
  puppet.stand(false, false);
  puppet.advance(30, 0.03);
  EXPECT_GT(puppet.reward_, 0.7);
  puppet.state_.q[simulation::kPelvisTilt] = -1.3;
  puppet.stand(true, false);
  EXPECT_EQ(puppet.advance(1), End::fall);
  EXPECT_NEAR(puppet.reward_, 0, 1e-9);
}

TEST(Task, OfAJumpIsPaidTheMoreTheLongerItStands) {
  Puppet puppet("long-jump");
  puppet.stand(false, false);
  puppet.advance(30);
  puppet.put_ankles(0.8, 0.8);
  puppet.stand(true, true);
  puppet.advance(25);
  EXPECT_NEAR(puppet.reward_, 0.8 * 0.25, 1e-9);
  EXPECT_EQ(puppet.advance(25), End::done);
  EXPECT_NEAR(puppet.reward_, 0.8, 1e-9);
}

TEST(Task, OfAJumpIsNothingWhereTheRunnerTipsOver) {
  Puppet puppet("long-jump");
  puppet.stand(false, false);
  puppet.advance(30, 0.03);
  puppet.put_ankles(1, 1);
  puppet.stand(true, true);
  puppet.advance(20);
  puppet.state_.q[simulation::kPelvisTilt] = 1.3;
  EXPECT_EQ(puppet.advance(1), End::fall);
  EXPECT_EQ(puppet.task_->measure_m(), 0);
}

TEST(Task, OfAJumpCountsNeitherStepsNorARunUp) {
  Puppet walker("long-jump");
  for (int step = 1; step <= 3; ++step) {  // a foot is always on the ground
    walker.stand(step % 2 == 0, step % 2 == 1);
    walker.put_ankles(0.3 * step, 0.3 * step);
    walker.advance(30, 0.01);
  }
  EXPECT_EQ(walker.task_->measure_m(), 0);

  Puppet runner("long-jump");
  runner.put_ankles(0.6, 0.6);
  runner.advance(10);
  runner.stand(false, false);
  runner.advance(30, 0.03);
  runner.put_ankles(2, 2);
  runner.stand(true, true);
  EXPECT_EQ(runner.advance(100), End::none);
  EXPECT_EQ(runner.task_->measure_m(), 0);
}

TEST(Task, OfAHopStandsOnTheRightFootAlone) {
  Puppet puppet("hop");
  puppet.stand(false, false);
  puppet.advance(20, 0.03);
  puppet.put_ankles(0.6, 0.9);
  puppet.stand(true, false);
  EXPECT_EQ(puppet.advance(60), End::done);
  EXPECT_NEAR(puppet.task_->measure_m(), 0.6, 1e-9);
}

TEST(Task, OfAJumpUpIsTheRiseOfTheCentreOfMass) {
  Puppet puppet("high-jump");
  puppet.stand(false, false);
  for (const double height : {1.1, 1.2, 1.3, 1.35, 1.38, 1.4, 1.38, 1.3}) {
    puppet.kinematics_.com.y = height;
    puppet.advance(2);
  }
  puppet.stand(true, true);
  EXPECT_EQ(puppet.advance(60), End::done);
  EXPECT_NEAR(puppet.task_->measure_m(), 0.4, 1e-9);
}

}  // namespace
}  // namespace stride::task
