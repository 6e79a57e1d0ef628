#include "extract/tracking/corrections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr int kFrames = 60;

/// A runner whose right leg swings; the left one is half a stride behind.
Trajectory runner() {
  Trajectory truth;
  for (int i = 0; i < kFrames; ++i) {
    TrajectoryFrame& frame = truth.frames.emplace_back();
    frame.frame = i;
    frame.time_s = i / 30.0;
    const auto put = [&](BodyPart part, const Vector2d& p) {
      frame[part] = {p, Source::detected, 0.8};
    };
    put(BodyPart::pelvis, {100.0 + 3 * i, 100});
    for (const bool left : {false, true}) {
      const double phase = 0.3 * i + (left ? 3.14 : 0), thigh = 0.6 * std::sin(phase),
                   shank = thigh - 0.5 + 0.4 * std::cos(phase);
      const Vector2d knee =
          frame[BodyPart::pelvis].p_px + 50 * Vector2d(std::sin(thigh), std::cos(thigh));
      const Vector2d ankle = knee + 50 * Vector2d(std::sin(shank), std::cos(shank));
      put(left ? BodyPart::knee_l : BodyPart::knee_r, knee);
      put(left ? BodyPart::ankle_l : BodyPart::ankle_r, ankle);
    }
  }
  return truth;
}

/// As a detector has it: the ankles too high on the shank by a tenth of it.
Trajectory detected(Trajectory truth) {
  for (TrajectoryFrame& frame : truth.frames)
    for (const auto& [ankle, knee] : {std::pair(BodyPart::ankle_r, BodyPart::knee_r),
                                      std::pair(BodyPart::ankle_l, BodyPart::knee_l)})
      frame[ankle].p_px += 0.1 * (frame[knee].p_px - frame[ankle].p_px);
  return truth;
}

Trajectory clicked(const Trajectory& truth, std::initializer_list<int> frames, BodyPart part) {
  Trajectory clicks;
  for (const int i : frames) {
    TrajectoryFrame& frame = clicks.frames.emplace_back();
    frame.frame = i;
    frame.time_s = i / 30.0;
    frame[part] = {truth.frames[static_cast<std::size_t>(i)][part].p_px, Source::clicked, 1};
  }
  return clicks;
}

double rms(const Trajectory& a, const Trajectory& b, BodyPart part) {
  double squared = 0;
  for (std::size_t i = 0; i < a.frames.size(); ++i)
    squared += (a.frames[i][part].p_px - b.frames[i][part].p_px).squaredNorm() / kFrames;
  return std::sqrt(squared);
}

TEST(Corrections, AClickStandsWhereItWasMade) {
  const Trajectory truth = runner();
  const Trajectory points = corrected(detected(truth), clicked(truth, {10, 40}, BodyPart::ankle_r));
  EXPECT_EQ(points.frames[40][BodyPart::ankle_r].p_px, truth.frames[40][BodyPart::ankle_r].p_px);
  EXPECT_EQ(points.frames[40][BodyPart::ankle_r].confidence, 1);
  EXPECT_EQ(points.frames[41][BodyPart::ankle_r].confidence, 0.8);
}

TEST(Corrections, OfOneAnkleMoveBothOnEveryFrame) {
  const Trajectory truth = runner(), before = detected(truth);
  const Trajectory points = corrected(before, clicked(truth, {5, 20, 35, 50}, BodyPart::ankle_r));
  for (const BodyPart ankle : {BodyPart::ankle_r, BodyPart::ankle_l})
    EXPECT_LT(rms(points, truth, ankle), 0.4 * rms(before, truth, ankle));
  EXPECT_EQ(rms(points, before, BodyPart::knee_r), 0);
}

double farthest_px(const Trajectory& a, const Trajectory& b, BodyPart part, int but) {
  double farthest = 0;
  for (std::size_t i = 0; i < a.frames.size(); ++i)
    if (a.frames[i].frame != but)
      farthest = std::max(farthest, (a.frames[i][part].p_px - b.frames[i][part].p_px).norm());
  return farthest;
}

TEST(Corrections, OfAPointThatIsWrongByItselfMoveNoOther) {
  const Trajectory truth = runner();
  Trajectory gross = truth, doubtful = truth;
  gross.frames[30][BodyPart::knee_r].p_px.x() += 40;  // on the other leg
  doubtful.frames[30][BodyPart::knee_r].p_px.x() += 6;
  doubtful.frames[30][BodyPart::knee_r].confidence = 0.3;
  for (const Trajectory& before : {gross, doubtful}) {
    const Trajectory points = corrected(before, clicked(truth, {30}, BodyPart::knee_r));
    EXPECT_EQ(points.frames[30][BodyPart::knee_r].p_px, truth.frames[30][BodyPart::knee_r].p_px);
    EXPECT_EQ(farthest_px(points, before, BodyPart::knee_r, 30), 0);
    EXPECT_EQ(farthest_px(points, before, BodyPart::knee_l, -1), 0);
  }
}

TEST(Corrections, DoNotSpreadTheNoiseOfAHand) {
  const Trajectory truth = runner();
  Trajectory clicks = clicked(truth, {30}, BodyPart::knee_r);
  clicks.frames[0][BodyPart::knee_r].p_px.x() += 3;  // twice a usual error, of a leg of 100 px
  const Trajectory points = corrected(truth, clicks);
  EXPECT_LT(farthest_px(points, truth, BodyPart::knee_r, 30), 1);
}

TEST(Corrections, AddFramesThatTheDetectorLost) {
  const Trajectory truth = runner();
  Trajectory before = detected(truth);
  before.frames.erase(before.frames.begin() + 20);
  const Trajectory points = corrected(before, clicked(truth, {20}, BodyPart::pelvis));
  ASSERT_EQ(points.frames.size(), truth.frames.size());
  EXPECT_EQ(points.frames[20].frame, 20);
  EXPECT_TRUE(points.frames[20][BodyPart::pelvis].present());
}

}  // namespace
}  // namespace stride::tracking
