#include "extract/tracking/track.h"

#include <gtest/gtest.h>

#include <cmath>

#include "extract/annotation/labelled_clip.h"
#include "extract/tracking/track_score.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

const std::filesystem::path kHuman = STRIDE_SOURCE_DIR "/videos/human.mp4";
const std::filesystem::path kClicks = STRIDE_SOURCE_DIR "/videos/human.keypoints.json";
const std::filesystem::path kTruth = STRIDE_SOURCE_DIR "/videos/human.truth.csv";

TEST(Track, BeatsTheSplineThroughTheSameClicks) {
  for (const tracking::TrackScore& score :
       tracking::score_tracking(kHuman, kTruth, {{4, 8}, {0, 1.5}, 0, 1})) {
    EXPECT_GE(score.gain(), 1.8) << score.spacing_frames << " frames, " << score.noise_px << " px";
    EXPECT_LT(score.tracked_px, 3)
        << score.spacing_frames << " frames, " << score.noise_px << " px";
  }
}

/// The shipped clip up to a frame, tracked from the shipped clicks.
tracking::Tracked tracked(const tracking::TrackOptions& options,
                          Keypoints keypoints = load_keypoints(kClicks), bool camera = false) {
  keypoints.trim = FrameRange{3, 40};
  video::DecodeOptions watching;
  watching.camera = camera;
  return tracking::track(kHuman, {tracking::marks_of(keypoints)}, options, watching);
}

TEST(Track, CoversEveryFrameFromTheFirstMarkToTheLast) {
  const tracking::Tracked result = tracked({});
  const auto& frames = result.trajectory.frames;
  EXPECT_EQ(frames.front().frame, 3);
  EXPECT_EQ(frames.back().frame, 3 + static_cast<int>(frames.size()) - 1);
  EXPECT_LE(frames.back().frame, 40);
  for (const TrajectoryFrame& frame : frames) {
    EXPECT_TRUE(frame[BodyPart::ankle_l].present());
    EXPECT_FALSE(frame[BodyPart::head].present());  // never clicked
    EXPECT_GT(frame[BodyPart::ankle_l].confidence, 0);
  }
  EXPECT_NEAR(result.trajectory.rate_hz, 30, 1e-6);
  EXPECT_EQ(result.trajectory.direction, Facing::right);
  EXPECT_EQ(frames.front()[BodyPart::knee_r].confidence, 1);
}

TEST(Track, IsNearlyTheSameFromPackedCrops) {
  Keypoints keypoints = load_keypoints(kClicks);
  keypoints.trim = FrameRange{3, 40};
  video::DecodeOptions packed;
  packed.camera = false;
  packed.most_bytes = 1e5;  // two crops
  const Trajectory whole = tracked({}, keypoints).trajectory,
                   other = tracking::track(kHuman, {tracking::marks_of(keypoints)}, {}, packed)
                               .trajectory;
  ASSERT_EQ(whole.frames.size(), other.frames.size());
  for (std::size_t i = 0; i < whole.frames.size(); ++i)
    for (const BodyPart part : kRequiredParts)
      EXPECT_LT((whole.frames[i][part].p_px - other.frames[i][part].p_px).norm(), 0.15)
          << whole.frames[i].frame << " " << name(part);
}

TEST(Track, GoesThroughTheMarksIfItIsAskedTo) {
  const Keypoints keypoints = load_keypoints(kClicks);
  tracking::TrackOptions options;
  options.keep_marks = true;
  for (const TrajectoryFrame& frame : tracked(options).trajectory.frames) {
    const auto clicked = keypoints.frames.find(frame.frame);
    if (clicked == keypoints.frames.end()) continue;
    for (const BodyPart part : kRequiredParts)
      EXPECT_LT((frame[part].p_px - clicked->second[part]->p_px).norm(), 0.1)
          << frame.frame << " " << name(part);
  }
}

TEST(Track, LeavesAPartOutWhereItWasSaidToBeAbsent) {
  Keypoints keypoints = load_keypoints(kClicks);
  int number = 0;
  std::vector<int> absent;
  for (auto& [frame, clicked] : keypoints.frames)
    if (++number == 4 || number == 5) {
      clicked[BodyPart::toe_l]->state = ClickState::absent;
      absent.push_back(frame);
    }
  tracking::TrackOptions options;
  options.flow = false;
  for (const TrajectoryFrame& frame : tracked(options, keypoints).trajectory.frames)
    EXPECT_EQ(frame[BodyPart::toe_l].present(),
              frame.frame < absent.front() || frame.frame > absent.back())
        << frame.frame;
}

TEST(Track, SeesThatTheCameraFollowsTheRunner) {
  const Trajectory result = tracked({}, load_keypoints(kClicks), true).trajectory;
  EXPECT_EQ(result.treadmill, false);
  for (std::size_t i = 1; i < result.frames.size(); ++i) {
    EXPECT_LT(result.frames[i].camera_px.x(), -3) << i;  // the background goes left
    EXPECT_LT(result.frames[i].camera_residual_px, 1) << i;
  }
}

TEST(Track, SaysWhatIsWrongWithTheMarks) {
  const video::DecodedClip two_frames{{0, 1}, 0, {}, {}, {}};
  Trajectory marks;
  marks.video = "a.mp4";
  EXPECT_ERROR(tracking::track(marks, two_frames), "a.mp4: no points are marked");
  marks.frames.resize(1);
  marks.frames[0].frame = 5;
  EXPECT_ERROR(tracking::track(marks, two_frames),
               "a.mp4: frame 5 is marked, but only 2 frames could be decoded");
  marks.frames[0].frame = 1;
  marks.frames[0][BodyPart::knee_r] = {{1, 1}, Source::clicked, 1};
  EXPECT_ERROR(tracking::track(marks, two_frames), "a.mp4: the pelvis is marked on no frame");
}

TEST(Track, CarriesASingleMarkedFrame) {
  Trajectory marks;
  marks.frames.resize(1);
  marks.frames[0].frame = 1;
  marks.frames[0][BodyPart::pelvis] = {{10, 20}, Source::clicked, 1};
  const Trajectory result =
      tracking::track(marks, video::DecodedClip{{0, 0.1}, 1, {}, {}, {}}).trajectory;
  ASSERT_EQ(result.frames.size(), 1u);
  EXPECT_LT((result.frames[0][BodyPart::pelvis].p_px - Eigen::Vector2d(10, 20)).norm(), 0.1);
}

TEST(Track, TellsTheWayTheRunnerFacesFromTheKnees) {
  Trajectory points = tracked({}).trajectory;
  EXPECT_EQ(tracking::facing(points), Facing::right);
  for (TrajectoryFrame& frame : points.frames)
    for (Point& point : frame.points) point.p_px.x() *= -1;
  EXPECT_EQ(tracking::facing(points), Facing::left);
  EXPECT_EQ(tracking::facing({}), std::nullopt);
}

}  // namespace
}  // namespace stride
