#include "extract/import/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "extract/import/parsing/labels.h"
#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

const std::filesystem::path kData = std::filesystem::path(STRIDE_TEST_DATA) / "import";

void expect_point(const Point& point, double x_px, double y_px, double confidence) {
  EXPECT_NEAR(point.p_px.x(), x_px, 1e-9);
  EXPECT_NEAR(point.p_px.y(), y_px, 1e-9);
  EXPECT_NEAR(point.confidence, confidence, 1e-9);
}

/// The parts that a layout of points has not.
std::vector<BodyPart> missing_in(std::size_t points) {
  const std::vector<std::string> labels = imports::layout_of(points);
  const std::vector<Point> all(points, Point{{1, 2}, Source::detected, 1});
  const auto found = imports::LabelMap(labels, {}, "a layout").parts(all);
  std::vector<BodyPart> missing;
  for (const BodyPart part : kBodyParts)
    if (!found[index(part)].present()) missing.push_back(part);
  return missing;
}

TEST(Import, FindsInEveryLayoutTheParts) {
  using enum BodyPart;
  using testing::ElementsAre;
  using testing::IsEmpty;
  for (const std::size_t points : {25, 26, 33, 133, 136})
    EXPECT_THAT(missing_in(points), IsEmpty()) << points;
  for (const std::size_t points : {15, 17, 18})
    EXPECT_THAT(missing_in(points), ElementsAre(toe_r, toe_l, heel_r, heel_l)) << points;
}

TEST(Import, ReadsAFolderOfOpenPose) {
  const imports::Detections detections = imports::import_points(kData / "openpose_body25");
  EXPECT_EQ(detections.format, "openpose");
  ASSERT_EQ(detections.frames.size(), 3u);
  EXPECT_EQ(detections.frames[1].frame, 1);
  expect_point(detections.frames[1][BodyPart::pelvis], 104, 120, 0.8);
  expect_point(detections.frames[1][BodyPart::knee_r], 114, 160, 0.9);
  expect_point(detections.frames[1][BodyPart::ankle_l], 74, 190, 0.5);
  expect_point(detections.frames[1][BodyPart::toe_r], 113, 204, 0.8);
  expect_point(detections.frames[1][BodyPart::head], 106, 41, 0.9);  // the ear, not the nose
}

TEST(Import, TakesThePelvisFromTheHipsAndLeavesAbsentPointsAbsent) {
  const imports::ImportedFrame frame = imports::import_points(kData / "openpose_body25").frames[2];
  expect_point(frame[BodyPart::pelvis], 108, 120, 0.7);
  EXPECT_FALSE(frame[BodyPart::knee_l].present());
}

TEST(Import, TakesTheLargestSustainedPersonOrTheOneAskedFor) {
  imports::ImportOptions options;
  options.person = 2;
  const imports::Detections small = imports::import_points(kData / "openpose_body25", options);
  ASSERT_EQ(small.frames.size(), 1u);
  EXPECT_EQ(small.frames[0].frame, 1);
  expect_point(small.frames[0][BodyPart::knee_r], 38, 160 / 3.0, 0.9);
  EXPECT_EQ(small.people[0].frames, 3);
  EXPECT_NEAR(small.people[0].height_px, 163, 1e-9);
  options.person = 3;
  EXPECT_ERROR(imports::import_points(kData / "openpose_body25", options), "person = 3");
}

TEST(Import, ReadsDeepLabCutAnalysis) {
  const imports::Detections detections = imports::import_points(kData / "deeplabcut_analysis.csv");
  EXPECT_EQ(detections.format, "deeplabcut");
  ASSERT_EQ(detections.frames.size(), 2u);
  expect_point(detections.frames[0][BodyPart::knee_r], 110.25, 160.5, 0.98);
  expect_point(detections.frames[0][BodyPart::pelvis], 100, 120, 0.8);
  EXPECT_FALSE(detections.frames[1][BodyPart::pelvis].present());
  EXPECT_FALSE(detections.frames[1][BodyPart::knee_l].present());
}

TEST(Import, DropsPointsBelowTheConfidenceAskedFor) {
  imports::ImportOptions options;
  options.min_confidence = 0.1;
  const imports::Detections detections =
      imports::import_points(kData / "deeplabcut_analysis.csv", options);
  ASSERT_EQ(detections.frames.size(), 2u);
  EXPECT_FALSE(detections.frames[1][BodyPart::knee_r].present());
  EXPECT_TRUE(detections.frames[0][BodyPart::knee_r].present());
}

TEST(Import, ReadsDeepLabCutLabelsInOrderOfFrames) {
  const imports::Detections detections = imports::import_points(kData / "deeplabcut_labels.csv");
  ASSERT_EQ(detections.frames.size(), 2u);
  EXPECT_EQ(detections.frames[0].frame, 7);
  expect_point(detections.frames[1][BodyPart::knee_r], 110.25, 160.5, 1);
}

TEST(Import, ReadsSeveralAnimalsByName) {
  const imports::Detections detections =
      imports::import_points(kData / "deeplabcut_two_animals.csv");
  EXPECT_EQ(detections.people.size(), 2u);
  expect_point(detections.frames[0][BodyPart::knee_r], 110, 120, 0.8);
}

TEST(Import, TakesLabelsFromTheUser) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "l.csv", "scorer,s,s\nbodyparts,p1,p1\ncoords,x,y\n0,3,4\n");
  EXPECT_ERROR(imports::import_points(folder / "l.csv"), "none of its labels (p1)");
  imports::ImportOptions options;
  options.labels["toe_l"] = "p1";
  expect_point(imports::import_points(folder / "l.csv", options).frames[0][BodyPart::toe_l], 3, 4,
               1);
  options.labels["toe_l"] = "p2";
  EXPECT_ERROR(imports::import_points(folder / "l.csv", options), "label 'p2' (for toe_l)");
}

TEST(Import, NamesFileLineAndWhatWasExpected) {
  const TemporaryFolder folder;
  const auto file = folder / "run_000000000003_keypoints.json";
  write_file_atomically(file, "{\"people\":\n [{\"pose_keypoints_2d\":\n  [1,2]}]}");
  EXPECT_ERROR(imports::import_points(file),
               "keypoints.json:3: expected 3 numbers for each of 15, 18");
  write_file_atomically(file, "{\"people\":\n [{\"pose_keypoints_2d\":\n  [1,2,\n\"x\"]}]}");
  EXPECT_ERROR(imports::import_points(file),
               "keypoints.json:4: expected a number at /people/0/pose_keypoints_2d/2, found \"x\"");
  write_file_atomically(file, "{\"people\":\n [{]}");
  EXPECT_ERROR(imports::import_points(file), "keypoints.json:2: not valid JSON at byte 14");
  write_file_atomically(folder / "d.csv",
                        "scorer,s,s\nbodyparts,knee_r,knee_r\ncoords,x,y\n0,1,b\n");
  EXPECT_ERROR(imports::import_points(folder / "d.csv"),
               "d.csv:4: column 3 = 'b': expected a number");
  write_file_atomically(folder / "d.csv", "hello\n");
  EXPECT_ERROR(imports::import_points(folder / "d.csv"),
               "d.csv:1: not a format of points that is known");
  EXPECT_ERROR(imports::import_points(folder / "nothing"), "no such file or folder");
  imports::ImportOptions options;
  options.format = "deeplabcut";
  EXPECT_ERROR(imports::import_points(folder.path(), options), "is a folder");
}

}  // namespace
}  // namespace stride
