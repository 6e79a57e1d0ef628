// Points of other programs that were made on another picture than the video's, or on other frames.
#include "extract/annotation/points_on_video.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "extract/io/error.h"
#include "extract/io/table.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

using Eigen::Vector2d;
using testing::HasSubstr;
using testing::Not;

const std::filesystem::path kSmall = STRIDE_SOURCE_DIR "/videos/small.mp4";  // 320 x 180, 24 Hz

/// The truth of small.mp4 as a detector would give it.
imports::Detections truth() {
  const Table table = load_csv(STRIDE_SOURCE_DIR "/videos/small.truth.csv");
  imports::Detections detections;
  detections.file = "points.csv";
  for (const auto& row : table.rows) {
    imports::ImportedFrame& frame = detections.frames.emplace_back();
    frame.frame = static_cast<int>(row[table.column("frame")]);
    for (const BodyPart part : kAskedParts) {
      const std::string prefix(name(part));
      frame[part] = {{row[table.column(prefix + "_x")], row[table.column(prefix + "_y")]},
                     Source::detected,
                     0.9};
    }
  }
  return detections;
}

template <typename Move>
imports::Detections moved(Move move) {
  imports::Detections detections = truth();
  for (imports::ImportedFrame& frame : detections.frames)
    for (Point& point : frame.points) point.p_px = move(point.p_px);
  return detections;
}

struct Told {
  tracking::LabelledClip labelled;
  std::string warnings;
};
Told told(const imports::Detections& detections,
          const tracking::PointsOnVideoOptions& options = {}) {
  testing::internal::CaptureStderr();
  try {
    Told result{tracking::points_on(kSmall, detections, options), {}};
    result.warnings = testing::internal::GetCapturedStderr();
    return result;
  } catch (const Error&) {
    testing::internal::GetCapturedStderr();
    throw;
  }
}

double farthest_px(const Trajectory& marks) {
  double farthest = 0;
  const imports::Detections right = truth();
  for (std::size_t i = 0; i < marks.frames.size(); ++i)
    for (const BodyPart part : kAskedParts)
      farthest =
          std::max(farthest, (marks.frames[i][part].p_px - right.frames[i][part].p_px).norm());
  return farthest;
}

TEST(PointsOnVideo, ThatFitAreTakenWithoutAWord) {
  const Told result = told(truth());
  EXPECT_THAT(result.warnings, Not(HasSubstr("warning")));
  EXPECT_LT(farthest_px(result.labelled.marks), 1e-9);
  EXPECT_EQ(result.labelled.marks.width_px, 320);
}

TEST(PointsOnVideo, OfADeclaredSizeAreScaled) {
  imports::Detections twice =
      moved([](const Vector2d& p) -> Vector2d { return 2 * p.array() + 0.5; });
  for (imports::ImportedFrame& frame : twice.frames) frame.width_px = 640, frame.height_px = 360;
  const Told declared = told(twice);
  EXPECT_THAT(declared.warnings, HasSubstr("640 x 360"));
  EXPECT_LT(farthest_px(declared.labelled.marks), 1e-9);
  for (imports::ImportedFrame& frame : twice.frames) frame.height_px = 480;
  EXPECT_ERROR(told(twice), "another video");
}

TEST(PointsOnVideo, OfASizeThatTheUserSaysAreScaled) {
  tracking::PointsOnVideoOptions options;
  options.import.size_px = {1, 1};
  const imports::Detections normalised =
      moved([](const Vector2d& p) { return Vector2d((p.x() + 0.5) / 320, (p.y() + 0.5) / 180); });
  EXPECT_LT(farthest_px(told(normalised, options).labelled.marks), 1e-9);
  EXPECT_THAT(told(normalised).warnings, HasSubstr("normalised coordinates, not pixels"));
}

TEST(PointsOnVideo, OfAnotherPictureDoNotFollowIt) {
  EXPECT_THAT(told(moved([](const Vector2d& p) -> Vector2d { return 0.5 * p; })).warnings,
              HasSubstr("--points-size 160 90"));
  EXPECT_THAT(
      told(moved([](const Vector2d& p) { return Vector2d(319 - p.x(), 179 - p.y()); })).warnings,
      HasSubstr("turned by 180 degrees"));
  EXPECT_THAT(told(moved([](const Vector2d& p) { return Vector2d(p.x(), 179 - p.y()); })).warnings,
              HasSubstr("--y-up 180"));
  EXPECT_THAT(
      told(moved([](const Vector2d& p) { return Vector2d(p.x() - 70, p.y() - 30); })).warnings,
      HasSubstr("do not follow the picture"));
}

TEST(PointsOnVideo, OfATrimmedCopyDoNotFollowIt) {
  imports::Detections early = truth();
  early.frames.erase(early.frames.begin(), early.frames.begin() + 6);
  for (imports::ImportedFrame& frame : early.frames) frame.frame -= 6;
  const Told result = told(early);
  EXPECT_THAT(result.warnings, HasSubstr("--first-frame -6"));
  EXPECT_THAT(result.warnings, HasSubstr("no points on the last 6"));
  tracking::PointsOnVideoOptions options;
  options.import.first_frame = -6;
  EXPECT_EQ(told(early, options).labelled.marks.frames.front().frame, 6);
}

TEST(PointsOnVideo, OfAFileThatDoesNotCountADropout) {
  imports::Detections renumbered = truth();
  auto& frames = renumbered.frames;
  frames.erase(frames.begin() + 30, frames.begin() + 43);
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].frame = static_cast<int>(i);
  const Told result = told(renumbered);
  EXPECT_THAT(result.warnings, HasSubstr("leap at frame 30"));
  EXPECT_THAT(result.warnings, HasSubstr("does not count 13 frames"));
  EXPECT_THAT(result.warnings, Not(HasSubstr("no points on the last")));
  const auto& marks = result.labelled.marks.frames;
  EXPECT_EQ(marks[29].frame, 29);
  EXPECT_EQ(marks[30].frame, 43);
  EXPECT_EQ(marks.back().frame, 95);
}

TEST(PointsOnVideo, OutsideThePictureAreLeftOutWhereTheyAreFew) {
  imports::Detections spoilt = truth();
  for (int i = 0; i < 4; ++i)
    spoilt.frames[static_cast<std::size_t>(9 * i)][BodyPart::ankle_l] = {
        {-250, -456}, Source::detected, 0.9};
  const Told result = told(spoilt);
  EXPECT_THAT(result.warnings, HasSubstr("outside the picture of 320 x 180 px, as far as (-250"));
  EXPECT_FALSE(result.labelled.marks.frames[9][BodyPart::ankle_l].present());
  EXPECT_THAT(told(moved([](const Vector2d& p) -> Vector2d { return 2 * p; })).warnings,
              HasSubstr("another size"));
}

TEST(PointsOnVideo, CountFramesFromOneWhereThatIsTheOnlyWay) {
  imports::Detections from_one = truth();
  for (imports::ImportedFrame& frame : from_one.frames) ++frame.frame;
  const Told result = told(from_one);
  EXPECT_THAT(result.warnings, HasSubstr("count from 1"));
  EXPECT_EQ(result.labelled.marks.frames.front().frame, 0);
  from_one.frames.back().frame += 13;
  EXPECT_ERROR(told(from_one), "points.csv: has points to frame");
}

TEST(PointsOnVideo, OfAnotherVideoAreRefused) {
  imports::Detections others = truth();
  others.video = "game.mp4";
  others.video_sha256 = std::string(64, 'a');
  EXPECT_ERROR(told(others), "belongs to another video (game.mp4");
}

TEST(PointsOnVideo, ThatAllLieInOnePlaceAreNobody) {
  imports::Detections spot = truth();
  spot.file = "spot.csv";
  for (imports::ImportedFrame& frame : spot.frames)
    for (Point& point : frame.points) point.p_px = {160, 90};
  const char* kWhat = "spot.csv: expected a person: the points of each frame lie within 0.0 px";
  spot.format = "mediapipe";
  EXPECT_ERROR(told(spot), kWhat);
  spot.format = "deeplabcut";
  EXPECT_THAT(told(spot).warnings, ::testing::HasSubstr(kWhat));
}

}  // namespace
}  // namespace stride
