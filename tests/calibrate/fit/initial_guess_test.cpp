#include "calibrate/fit/initial_guess.h"

#include <gtest/gtest.h>

#include "tests/calibrate/synthetic.h"

namespace stride {
namespace {

fit::Marks marks_of(const SyntheticClip& clip) {
  return fit::observe(synthetic_trajectory(synthetic_runner(), default_sagittal_model(), clip),
                      clip.to_left);
}

TEST(InitialGuess, OfThePeriodIsThatOfTheRunnerInSpiteOfOutliers) {
  for (const SyntheticClip& clip :
       {SyntheticClip{}, SyntheticClip{.noise_px = 3, .outliers = 0.1},
        SyntheticClip{.rate_hz = 12}, SyntheticClip{.duration_s = 1, .to_left = true}}) {
    const auto guesses = fit::guess_periods(marks_of(clip), 3);
    ASSERT_FALSE(guesses.empty());
    EXPECT_NEAR(guesses[0].period_s, 0.69, 0.02);
    EXPECT_GT(guesses[0].explained, 0.8);
    for (std::size_t i = 1; i < guesses.size(); ++i) {
      EXPECT_LE(guesses[i].explained, guesses[0].explained);
      EXPECT_GT(std::abs(std::log(guesses[i].period_s / guesses[0].period_s)), 0.15);
    }
  }
}

TEST(InitialGuess, NeedsMarks) {
  EXPECT_TRUE(fit::guess_periods(marks_of({.rate_hz = 4, .duration_s = 1}), 3).empty());
}

TEST(InitialGuess, OfTheLimbsIsNearTheTruth) {
  const Runner truth = synthetic_runner();
  const double leg_m = truth.body[body::thigh] + truth.body[body::shank];
  const Runner runner = fit::guess_runner(marks_of({}), default_sagittal_model(), 0.69, leg_m);
  EXPECT_NEAR(runner.camera[camera::log_px_per_m], truth.camera[camera::log_px_per_m], 0.05);
  for (const int length : {body::thigh, body::shank, body::foot})
    EXPECT_NEAR(runner.body[length], truth.body[length], 0.05 * truth.body[length]);
  for (const double phase : {0.0, 0.3, 0.6, 0.9})  // relative to the ground, not the tilted pelvis
    EXPECT_NEAR(evaluate_series(runner.knee.data(), 4, phase),
                evaluate_series(truth.knee.data(), 3, phase), 0.1);
}

}  // namespace
}  // namespace stride
