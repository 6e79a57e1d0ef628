#include "shaping/keyframes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/throws.h"

namespace stride {
namespace {

/// A run whose parts move on sines of the phase, sampled at irregular times.
CalibratedTrajectory sines(int samples) {
  CalibratedTrajectory run;
  run.source = "sines";
  run.period_s = 0.7;
  for (int i = 0; i < samples; ++i) {
    CalibratedSample& sample = run.samples.emplace_back();
    sample.time_s = 0.0137 * i;
    sample.phase = sample.time_s / 0.7 - std::floor(sample.time_s / 0.7);
    const auto wave = [&](double at) { return std::sin(2 * std::numbers::pi * at); };
    sample.p_m.fill(Eigen::Vector2d::Zero());
    sample.coordinates[2] = 0.9 + 0.03 * wave(2 * sample.phase);
    sample.p_m[index(BodyPart::knee_r)] = {0.2 * wave(sample.phase), -0.4};
    sample.p_m[index(BodyPart::knee_l)] = {0.2 * wave(sample.phase + 0.5) + 0.01, -0.4};
    sample.p_m[index(BodyPart::ankle_r)] = {0.3 * wave(sample.phase + 0.1), -0.8};
    sample.p_m[index(BodyPart::toe_r)] = {1, 2};
    sample.sd_m[index(BodyPart::knee_r)] = {0.01, 0.02};
  }
  return run;
}

TEST(Keyframes, LieOnTheMeanStrideOfARun) {
  KeyframeOptions options;
  options.symmetric = false;
  const Potential potential = make_potential(sines(120), options, "a.calibrated.csv");
  ASSERT_EQ(potential.keyframes.size(), 8u);
  for (const Keyframe& keyframe : potential.keyframes) {
    const double turn = 2 * std::numbers::pi * keyframe.phase;
    EXPECT_NEAR(keyframe.pose[PosePart::knee_r].x(), 0.2 * std::sin(turn), 1e-9);
    EXPECT_NEAR(keyframe.pose.pelvis_height_m(), 0.9 + 0.03 * std::sin(2 * turn), 1e-9);
    EXPECT_EQ(keyframe.sd[PosePart::knee_r], Eigen::Vector2d(0.01, 0.02));
  }
}

TEST(Keyframes, MakeLegsMirrorImagesUnlessToldOtherwise) {
  const Potential potential = make_potential(sines(120), {}, "a");
  for (std::size_t k = 0; k < 8; ++k) {
    const Pose here = potential.keyframes[k].pose,
               later = potential.keyframes[(k + 4) % 8].pose.mirrored();
    EXPECT_NEAR(here[PosePart::knee_r].x(), later[PosePart::knee_r].x(), 1e-9);
    EXPECT_NEAR(here[PosePart::foot_l].x(), later[PosePart::foot_l].x(), 1e-9);
  }
  EXPECT_NEAR(potential.keyframes[0].pose[PosePart::knee_r].x(), 0.005,
              1e-9);  // half of the asymmetry
}

TEST(Keyframes, TakeTheToeForTheFootIfAsked) {
  KeyframeOptions options;
  options.foot = "toe";
  options.symmetric = false;
  const Potential potential = make_potential(sines(120), options, "a");
  EXPECT_EQ(potential.foot, "toe");
  EXPECT_NEAR(potential.keyframes[3].pose[PosePart::foot_r].y(), 2, 1e-9);
}

TEST(Keyframes, NeedAWholeStrideAndAnEvenNumber) {
  EXPECT_ERROR(make_potential(sines(30), {}, "a.calibrated.csv"),
               "a.calibrated.csv: no sample for 4");
  KeyframeOptions odd;
  odd.count = 7;
  EXPECT_ERROR(make_potential(sines(120), odd, "a"), "keyframes = 7: must be even");
}

}  // namespace
}  // namespace stride
