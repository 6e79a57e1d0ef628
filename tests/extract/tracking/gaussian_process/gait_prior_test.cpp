#include "extract/tracking/gaussian_process/gait_prior.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace stride {
namespace {

constexpr double kPeriod_s = 0.7;

/// A runner in closed form: the pelvis bobs every step before a panning camera, knees and ankles
/// repeat every stride, the left half a stride behind. He faces right: feet go back low.
Eigen::Vector2d place(BodyPart part, double t) {
  const double step = 4 * std::numbers::pi * t / kPeriod_s;
  const Eigen::Vector2d pelvis(300 + 12 * std::sin(1.3 * t), 180 + 6 * std::cos(step));
  if (part == BodyPart::pelvis) return pelvis;
  const bool left = part == BodyPart::knee_l || part == BodyPart::ankle_l;
  const double phase = 2 * std::numbers::pi * (t / kPeriod_s + (left ? 0.5 : 0));
  const Eigen::Vector2d knee(25 * std::sin(phase), 50 - 5 * std::cos(2 * phase));
  if (part == BodyPart::knee_r || part == BodyPart::knee_l) return pelvis + knee;
  return pelvis + knee +
         Eigen::Vector2d(-20 + 25 * std::cos(phase) + 6 * std::sin(2 * phase),
                         45 + 15 * std::sin(phase + 0.4));
}

gaussian_process::Observations clicks(double spacing_s, double until_s) {
  gaussian_process::Observations result;
  for (double t = 0; t < until_s; t += spacing_s)
    for (const BodyPart part : kRequiredParts)
      result[index(part)].push_back({t, place(part, t), Eigen::Vector2d::Constant(0.01)});
  return result;
}

TEST(GaitPrior, FindsThePeriodOfTheStride) {
  for (const double spacing_s : {0.1, 0.133, 0.166, 0.2, 0.266})
    EXPECT_NEAR(gaussian_process::fit_gait_prior(clicks(spacing_s, 3.2)).legs.period_s, kPeriod_s,
                0.01)
        << spacing_s;
}

TEST(GaitPrior, TellsAStrideFromOneThatGoesBackwards) {
  // Less than two clicks a stride: a stride of 0.741 s reversed in time is an alias.
  EXPECT_NEAR(gaussian_process::fit_gait_prior(clicks(0.36, 5)).legs.period_s, kPeriod_s, 0.02);
}

TEST(GaitPrior, FindsInWaysThePeriodThatClicksCannotTell) {
  gaussian_process::Observations seen = clicks(0.34, 5);
  gaussian_process::GaitPrior prior = gaussian_process::fit_gait_prior(seen);
  for (const BodyPart part : kRequiredParts)
    for (double t = 0.1; t < 4.7; t += 0.1)
      seen[index(part)].push_back(
          {t, place(part, t) - place(part, t - 0.03), Eigen::Vector2d::Constant(0.1), t - 0.03});
  prior.legs.period_s = prior.trunk.period_s = 0.97 * kPeriod_s;
  EXPECT_NEAR(gaussian_process::with_period_of(prior, seen).legs.period_s, kPeriod_s, 0.002);
}

TEST(GaitPrior, FillsGapsFromOtherStridesAndTheOtherLeg) {
  const gaussian_process::Observations seen = clicks(0.2, 3.2);
  const gaussian_process::GaitPrior prior = gaussian_process::fit_gait_prior(seen);
  std::vector<double> times_s;
  for (double t = 0; t < 3; t += 0.033) times_s.push_back(t);
  const gaussian_process::Estimates estimates = gaussian_process::estimate(prior, seen, times_s);
  double squared = 0;
  for (std::size_t i = 0; i < times_s.size(); ++i)
    squared += (estimates[i][index(BodyPart::ankle_l)].p_px - place(BodyPart::ankle_l, times_s[i]))
                   .squaredNorm();
  EXPECT_LT(std::sqrt(squared / static_cast<double>(times_s.size())), 1.0);
}

TEST(GaitPrior, GoesThroughExactObservationsAndHasNoPartThatWasNotSeen) {
  gaussian_process::Observations seen = clicks(0.2, 3.2);
  const gaussian_process::GaitPrior prior = gaussian_process::fit_gait_prior(seen);
  for (auto& part : seen)
    for (gaussian_process::Observation& o : part) o.variance_px2.setConstant(1e-4);
  const gaussian_process::Estimates estimates = gaussian_process::estimate(prior, seen, {0.4});
  EXPECT_LT((estimates[0][index(BodyPart::knee_r)].p_px - place(BodyPart::knee_r, 0.4)).norm(),
            0.1);
  EXPECT_FALSE(estimates[0][index(BodyPart::toe_r)].p_px.allFinite());
}

TEST(GaitPrior, IsLessCertainFartherFromObservations) {
  const gaussian_process::Observations seen = clicks(0.1, 1.5);
  const gaussian_process::Estimates estimates =
      gaussian_process::estimate(gaussian_process::fit_gait_prior(seen), seen, {0.7, 2.5});
  EXPECT_LT(estimates[0][index(BodyPart::knee_r)].variance_px2.x(),
            estimates[1][index(BodyPart::knee_r)].variance_px2.x());
}

TEST(GaitPrior, TakesAWayAsWellAsAPlace) {
  gaussian_process::Observations seen = clicks(0.2, 3.2);
  const gaussian_process::GaitPrior prior = gaussian_process::fit_gait_prior(seen);
  for (auto& part : seen)
    for (gaussian_process::Observation& o : part) o.variance_px2.setConstant(1e-2);
  gaussian_process::Observation displacement;
  displacement.since_s = 0.4;
  displacement.time_s = 0.5;
  displacement.p_px =
      place(BodyPart::knee_r, 0.5) - place(BodyPart::knee_r, 0.4) + Eigen::Vector2d(7, 0);
  displacement.variance_px2.setConstant(1e-4);
  seen[index(BodyPart::knee_r)].push_back(displacement);
  const gaussian_process::Estimates estimates = gaussian_process::estimate(prior, seen, {0.4, 0.5});
  const Eigen::Vector2d went =
      estimates[1][index(BodyPart::knee_r)].p_px - estimates[0][index(BodyPart::knee_r)].p_px;
  EXPECT_LT((went - displacement.p_px).norm(), 0.5);
}

TEST(GaitPrior, GivesTheSameInWindowsAsTogether) {
  const gaussian_process::Observations dense = clicks(0.01, 4.5);  // too many for one regression
  const gaussian_process::GaitPrior prior = gaussian_process::fit_gait_prior(dense);
  std::vector<double> times_s;
  for (double t = 0.005; t < 4.4; t += 0.1) times_s.push_back(t);
  const gaussian_process::Estimates estimates = gaussian_process::estimate(prior, dense, times_s);
  for (std::size_t i = 0; i < times_s.size(); ++i)
    EXPECT_LT(
        (estimates[i][index(BodyPart::ankle_r)].p_px - place(BodyPart::ankle_r, times_s[i])).norm(),
        0.5);
}

}  // namespace
}  // namespace stride
