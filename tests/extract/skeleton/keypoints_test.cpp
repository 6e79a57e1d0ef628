#include "extract/skeleton/keypoints.h"

#include <gtest/gtest.h>

#include <cmath>

#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

Keypoints example() {
  Keypoints k;
  k.video = "a.mp4";
  k.video_sha256 = std::string(64, '0');
  k.width_px = 640;
  k.height_px = 360;
  k.direction = Facing::left;
  k.near_leg = Side::right;
  k.slow_motion = 4;
  k.treadmill = true;
  k.trim = FrameRange{3, 90};
  k.floor = FloorLine{{0, 300}, {639, 301.5}};
  k.calibration_line = CalibrationLine{7, {100, 40.5}, {100, 240.5}, 1.5};
  k.notes = "windy";
  k.corrects_network = true;
  k.frames[5].time_s = 0.1;
  k.frames[5][BodyPart::pelvis] = {{320.25, 180.5}, ClickState::seen, {}};
  k.frames[5][BodyPart::knee_l] = {{300, 200}, ClickState::estimated, {}};
  k.frames[12].time_s = 0.3;
  k.frames[12][BodyPart::toe_l] = {{}, ClickState::absent, {}};
  return k;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Keypoints, ReadBackAsTheyWereSaved) {
  const TemporaryFolder folder;
  save(example(), folder / "a.keypoints.json");
  const Keypoints k = load_keypoints(folder / "a.keypoints.json");
  EXPECT_EQ(k.video, "a.mp4");
  EXPECT_EQ(k.direction, Facing::left);
  EXPECT_EQ(k.near_leg, Side::right);
  EXPECT_EQ(k.slow_motion, 4);
  EXPECT_EQ(k.treadmill, true);
  EXPECT_TRUE(k.corrects_network);
  EXPECT_EQ(k.trim->last, 90);
  EXPECT_EQ(k.floor->to_px, Eigen::Vector2d(639, 301.5));
  EXPECT_EQ(k.calibration_line->frame, 7);
  EXPECT_EQ(k.calibration_line->to_px, Eigen::Vector2d(100, 240.5));
  EXPECT_DOUBLE_EQ(k.calibration_line->metres_per_pixel(), 0.0075);
  EXPECT_EQ(k.notes, "windy");
  ASSERT_EQ(k.frames.size(), 2u);
  EXPECT_EQ(k.frames.at(5)[BodyPart::pelvis]->p_px, Eigen::Vector2d(320.25, 180.5));
  EXPECT_EQ(k.frames.at(5)[BodyPart::knee_l]->state, ClickState::estimated);
  EXPECT_FALSE(k.frames.at(5)[BodyPart::knee_r].has_value());
  EXPECT_FALSE(k.frames.at(12).placed(BodyPart::toe_l));
  EXPECT_EQ(k.frames.at(12)[BodyPart::toe_l]->state, ClickState::absent);
}

TEST(Keypoints, ReadBackEveryPart) {
  for (const BodyPart part : kBodyParts) {
    const TemporaryFolder folder;
    Keypoints k = example();
    k.frames.clear();
    k.frames[3][part] = {{320.25, 180.5}, ClickState::seen, {}};
    save(k, folder / "a.keypoints.json");
    const Keypoints loaded = load_keypoints(folder / "a.keypoints.json");
    for (const BodyPart other : kBodyParts)
      EXPECT_EQ(loaded.frames.at(3).placed(other), other == part) << name(other);
    EXPECT_EQ(loaded.frames.at(3)[part]->p_px, Eigen::Vector2d(320.25, 180.5)) << name(part);
  }
}

TEST(Keypoints, KeepWhatALaterProgramAdded) {
  const TemporaryFolder folder;
  const auto file = folder / "a.keypoints.json";
  save(example(), file);
  std::string text = read_file(file);
  text = replaced(text, "\"notes\"", "\"weather\": {\"rain\": true},\n \"notes\"");
  text = replaced(text, "\"frame\": 5,", "\"frame\": 5, \"author\": \"me\",");
  text = replaced(text, "\"x\": 320.25", "\"sigma\": 0.5, \"x\": 320.25");
  write_file_atomically(file, text);
  save(load_keypoints(file), file);
  const std::string again = read_file(file);
  for (const char* kept : {"\"rain\": true", "\"author\": \"me\"", "\"sigma\": 0.5"})
    EXPECT_THAT(again, testing::HasSubstr(kept));
}

TEST(Keypoints, RefuseBadValuesByFileFramePartAndRule) {
  const TemporaryFolder folder;
  const auto file = folder / "a.keypoints.json";
  save(example(), file);
  const std::string good = read_file(file);
  const auto reject = [&](const char* from, const char* to, const char* message) {
    write_file_atomically(file, replaced(good, from, to));
    EXPECT_ERROR(load_keypoints(file), message);
  };
  reject("\"version\": 1", "\"version\": 2",
         "a.keypoints.json: version 2: this program reads up to version 1; use a newer stride");
  reject("stride keypoints", "something", "not a file of clicks");
  reject("\"knee_l\"", "\"elbow\"", "a.keypoints.json: frame 5: body part 'elbow': not known");
  reject("320.25", "640.25", "frame 5: pelvis = (640.25, 180.5): outside the frame of 640×360 px");
  reject("320.25", "NaN", "a.keypoints.json: not valid JSON");
  reject("320.25", "null", "frame 5: pelvis: x = null: must be a number of pixels");
  reject("320.25", "1e999", "a.keypoints.json: not valid JSON");
  reject("\"length_m\": 1.5", "\"length_m\": 0", "calibration_line: length 0 m: must be 0.05 to");
  reject("240.5", "2400.5", "calibration_line: must lie in the picture of 640×360 px");
  reject("240.5", "41.5", "calibration_line: 1.0 px long: must be 10 px or more");
  reject("\"estimated\"", "\"guessed\"", "frame 5: knee_l: state = guessed: must be seen");
  reject("\"frame\": 12", "\"frame\": 5", "frame 5 appears twice");
  reject("\"time_s\": 0.3", "\"time_s\": 0.05",
         "frame 12: time_s = 0.05: must be later than frame 5");
  reject("\"left\"", "\"up\"", "direction = up: must be right or left");
  reject("\"slow_motion\": 4.0", "\"slow_motion\": 0", "slow_motion = 0: must be in");
  reject("\"slow_motion\": 4.0", "\"slow_motion\": 1e9", "slow_motion = 1000000000: must be in");
}

TEST(Keypoints, AreNotSavedWithNonsense) {
  const TemporaryFolder folder;
  Keypoints k = example();
  k.frames[5][BodyPart::pelvis]->p_px.x() = std::nan("");
  EXPECT_ERROR(save(k, folder / "a.keypoints.json"), "frame 5: pelvis = (nan, 180.5)");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.keypoints.json"));
}

TEST(Keypoints, BelongToOneVideo) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "b.mp4", "abc");
  EXPECT_ERROR(check_belongs_to(example(), folder / "b.mp4"),
               "b.mp4: is another video than the one that was clicked (a.mp4, SHA-256 00000");
  EXPECT_EQ(keypoints_file_of("x/run.mp4"), "x/run.keypoints.json");
}

}  // namespace
}  // namespace stride
