#include "train/rollout/gait_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/throws.h"
#include "train/rollout/clip_similarity.h"
#include "train/rollout/human_gait.h"
#include "train/rollout/rollout.h"

namespace stride {
namespace {

/// A regular runner: 3 m/s, a stride of 0.7 s, each foot on the ground for 0.21 s of it, right at
/// phase 0, left at phase ½; the ankle strikes under the pelvis.
class Clockwork : public ::testing::Test {
 protected:
  Clockwork() : model_(osim::load_osim(osim::default_model_file())) {
    for (int i = 0; i <= 500; ++i) {
      rollout::RolloutFrame frame;
      const double t = 0.01 * i, strides = t / 0.7;
      frame.state.time_s = t;
      frame.state.q[simulation::kPelvisX] = 3 * t;
      frame.state.q[simulation::kPelvisY] = 0.9;
      frame.kinematics.bodies.resize(model_.bodies.size());
      for (auto& body : frame.kinematics.bodies) body.position = {3 * t, 0.9};
      for (int side = 0; side < 2; ++side) {
        const double phase = strides + 0.5 * side - std::floor(strides + 0.5 * side);
        if (phase < 0.3)
          frame.kinematics.ground_reaction_N[static_cast<std::size_t>(side)].y =
              2 * rollout::weight_N(model_);
      }
      rollout_.frames.push_back(frame);
    }
  }

  osim::Model model_;
  rollout::Rollout rollout_;
};

TEST_F(Clockwork, HasTheFiguresItWasMadeWith) {
  const rollout::GaitSummary gait = rollout::gait_of(rollout_, model_);
  EXPECT_NEAR(gait.speed_m_s, 3, 1e-9);
  EXPECT_NEAR(gait.cadence_per_min, 120 / 0.7, 2);
  EXPECT_NEAR(gait.step_length_m, 3 * 0.35, 0.02);
  EXPECT_NEAR(gait.stride_s, 0.7, 0.01);
  EXPECT_NEAR(gait.duty_factor, 0.3, 0.02);
  EXPECT_NEAR(gait.flight_share, 0.4, 0.02);
  EXPECT_NEAR(gait.peak_ground_force_bw, 2, 1e-9);
  EXPECT_NEAR(gait.leg_phase, 0.5, 0.01);
}

TEST_F(Clockwork, BothLegsAtOnceAreAHop) {
  for (rollout::RolloutFrame& frame : rollout_.frames) {
    auto& force = frame.kinematics.ground_reaction_N;
    force[1] = force[0];
  }
  EXPECT_NEAR(rollout::gait_of(rollout_, model_).leg_phase, 0, 1e-9);
  EXPECT_THAT(rollout::leg_pattern(0), ::testing::HasSubstr("hops"));
  EXPECT_THAT(rollout::leg_pattern(0.48), ::testing::HasSubstr("turns"));
}

/// A clip at twice the cadence with the same angles by phase is the same run; one with a knee 20
/// degrees further has one angle of six outside the band.
TEST_F(Clockwork, IsLikeAClipWithItsAnglesAtEachPhase) {
  const auto angle = [](double phase) { return 0.5 * std::sin(2 * std::numbers::pi * phase); };
  for (rollout::RolloutFrame& frame : rollout_.frames)
    for (std::size_t k = 3; k < 9; ++k) frame.state.q[k] = angle(frame.state.time_s / 0.7);
  CalibratedTrajectory clip;
  for (int i = 0; i < 70; ++i) {
    CalibratedSample& sample = clip.samples.emplace_back();
    sample.phase = i / 35.0 - std::floor(i / 35.0);
    for (std::size_t k = 3; k < 9; ++k) sample.coordinates[k] = angle(sample.phase);
  }
  const rollout::ClipSimilarity same = rollout::similarity(rollout_, clip, model_);
  EXPECT_LT(same.angle_rms_deg, 4);  // a hundredth of a second and a fortieth of a stride
  EXPECT_EQ(same.inside_share, 1);
  for (CalibratedSample& sample : clip.samples) sample.coordinates[4] += std::numbers::pi / 9;
  const rollout::ClipSimilarity other = rollout::similarity(rollout_, clip, model_);
  EXPECT_NEAR(other.angle_rms_deg, 20 / std::sqrt(6.0), 1);
  EXPECT_NEAR(other.inside_share, 5.0 / 6, 0.02);
  EXPECT_TRUE(std::isnan(rollout::similarity(rollout_, clip, model_, 100).inside_share));
}

TEST(HumanGait, HoldsTheRunnersThatItIsOf) {
  const rollout::HumanGait slow = rollout::human_gait(2.5).value(),
                           fast = rollout::human_gait(4.5).value();
  EXPECT_NEAR((slow.cadence_per_min.low + slow.cadence_per_min.high) / 2, 162, 1e-9);
  EXPECT_NEAR((fast.duty_factor.low + fast.duty_factor.high) / 2, 0.328, 1e-9);
  // Strides of 1.86 and 2.96 m were measured at those speeds.
  EXPECT_TRUE(slow.step_length_m.holds(1.86 / 2));
  EXPECT_TRUE(fast.step_length_m.holds(2.96 / 2));
  // The runner of Rajagopal et al. 2016 at 3.8 m/s: strides of 2.6 to 2.7 m, duty factor 0.335.
  const rollout::HumanGait other = rollout::human_gait(3.8).value();
  EXPECT_TRUE(other.step_length_m.holds(2.65 / 2));
  EXPECT_TRUE(other.duty_factor.holds(0.335));
  EXPECT_FALSE(other.cadence_per_min.holds(423));
  EXPECT_FALSE(rollout::human_gait(1.6).has_value()) << "that is a walk";
  EXPECT_FALSE(rollout::human_gait(NAN).has_value());
}

TEST_F(Clockwork, ChatterShorterThan30MsIsNoStep) {
  const std::size_t steps = rollout::foot_contacts(rollout_, model_).size();
  for (std::size_t i = 20; i < rollout_.frames.size(); i += 35)
    rollout_.frames[i].kinematics.ground_reaction_N[0].y = 0;  // within a stance, or in the air
  EXPECT_EQ(rollout::foot_contacts(rollout_, model_).size(), steps);
}

// A foot that leaves the ground for 60 ms in the middle of each stance, as on a stiff floor.
TEST_F(Clockwork, AFootThatReboundsMakesOneStep) {
  for (std::size_t i = 0; i < rollout_.frames.size(); ++i)
    for (const std::size_t side : {0u, 1u}) {
      const std::size_t in_stride = (i + 35 * side) % 70;
      if (in_stride >= 8 && in_stride < 14)
        rollout_.frames[i].kinematics.ground_reaction_N[side].y = 0;
    }
  const rollout::GaitSummary gait = rollout::gait_of(rollout_, model_);
  EXPECT_NEAR(gait.cadence_per_min, 120 / 0.7, 2);
  EXPECT_NEAR(gait.leg_phase, 0.5, 0.01);
  EXPECT_NEAR(gait.duty_factor, 0.3, 0.02);
}

TEST_F(Clockwork, ARunnerThatStandsHasNoSteps) {
  for (rollout::RolloutFrame& frame : rollout_.frames) {
    frame.state.q[simulation::kPelvisX] = 0;
    for (auto& force : frame.kinematics.ground_reaction_N) force.y = rollout::weight_N(model_) / 2;
  }
  const rollout::GaitSummary gait = rollout::gait_of(rollout_, model_);
  EXPECT_TRUE(std::isnan(gait.cadence_per_min));
  EXPECT_TRUE(std::isnan(gait.duty_factor));
  EXPECT_EQ(gait.speed_m_s, 0);
  EXPECT_ERROR(rollout::demonstration(rollout_, model_, 0),
               "a demonstration needs two; train longer");
}

TEST_F(Clockwork, IsADemonstrationOfItsOwnStride) {
  const CalibratedTrajectory run = rollout::demonstration(rollout_, model_, 1);
  EXPECT_NEAR(run.period_s, 0.7, 0.003);
  EXPECT_NEAR(run.speed_m_s, 3, 1e-9);
  EXPECT_EQ(run.model, model_.name);
  EXPECT_EQ(run.samples.front().phase, 0);
  EXPECT_GE(run.samples.front().time_s, 1);
  for (const CalibratedSample& sample : run.samples) {
    EXPECT_GE(sample.phase, 0);
    EXPECT_LT(sample.phase, 1);
    EXPECT_NEAR(sample.coordinates[1], 3 * sample.time_s, 1e-12);
  }
}

}  // namespace
}  // namespace stride
