#include "calibrate/fit/stance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibrate/fit/fit.h"

namespace stride {
namespace {

constexpr double kLeg_m = 0.8, kPeriod_s = 0.7;

/// Straight legs that swing as pendulums, θ = a cos 2πφ: the ankle is at L (sin θ, −cos θ).
fit::StrideFit pendulum(double a) {
  fit::StrideFit fit;
  fit.harmonics = 1;
  fit.runner.cadence[cadence::period_s] = kPeriod_s;
  fit.runner.body[body::thigh] = 0.45;
  fit.runner.body[body::shank] = kLeg_m - 0.45;
  fit.runner.hip[1] = a;
  return fit;
}

fit::Stance stance_of(const fit::StrideFit& fit, BodyPart part) {
  const SagittalModel model = sagittal_model(osim::load_osim(osim::default_model_file()));
  return fit::find_stance(fit, Directions(model), part);
}

TEST(Stance, IsWhereTheFootIsLowAndGoesBack) {
  const double a = 0.3;
  for (const BodyPart part : {BodyPart::ankle_r, BodyPart::ankle_l}) {
    const fit::Stance stance = stance_of(pendulum(a), part);
    const double shift = part == BodyPart::ankle_r ? 0 : 0.5;
    std::size_t expected = 0;
    for (int i = 0; i < 96; ++i) {
      const double own = i / 96.0 + shift, angle = a * std::cos(2 * std::numbers::pi * own);
      const bool back = std::sin(2 * std::numbers::pi * own) > 1e-9;
      expected += back && 1 - std::cos(angle) < 0.025 ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(stance.phases.size()), static_cast<double>(expected), 1);
    for (const double phase : stance.phases) {
      const double own = phase + shift - std::floor(phase + shift);
      EXPECT_GT(own, 0);
      EXPECT_LT(own, 0.5);
      EXPECT_LT(1 - std::cos(a * std::cos(2 * std::numbers::pi * own)), 0.0251);
    }
  }
}

TEST(Stance, TellsTheSpeedOfAPendulumsFoot) {
  // The slope by least squares of −L a sin 2πt over half a cycle: L a (1/2π²) / (1/96) a cycle.
  const double a = 0.05;
  const double expected = kLeg_m * a * 96 / (2 * std::numbers::pi * std::numbers::pi) / kPeriod_s;
  EXPECT_NEAR(stance_of(pendulum(a), BodyPart::ankle_r).speed_m_s, expected, 0.03 * expected);
}

TEST(Stance, IsNotThatOfAFootThatHangsStill) {
  const fit::Stance stance = stance_of(pendulum(0), BodyPart::ankle_r);
  EXPECT_EQ(stance.speed_m_s, 0);
}

}  // namespace
}  // namespace stride
