// Every sample of every format describes the same figure (data/import/README.md), and a damaged
// file imports or throws Error.
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "extract/import/import.h"
#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(STRIDE_TEST_DATA) / "import";

struct Sample {
  const char* file;
  const char* format;
  int first_frame = 0, frames = 3;
  int y_up_height_px = 0;
  bool needs_labels = false;
};

const std::vector<Sample> kSamples{
    {"openpose_coco18_000000000001_keypoints.json", "openpose", 1, 1},
    {"openpose_mpi15_000000000001_keypoints.json", "openpose", 1, 1},
    {"coco_results.json", "coco"},
    {"coco_annotations.json", "coco"},
    {"alphapose.json", "alphapose"},
    {"mmpose.json", "mmpose"},
    {"mediapipe_wide.csv", "mediapipe"},
    {"mediapipe_numbered.csv", "mediapipe"},
    {"mediapipe_long.csv", "mediapipe"},
    {"mediapipe.json", "mediapipe"},
    {"mediapipe_tasks.json", "mediapipe"},
    {"ultralytics.json", "ultralytics"},
    {"ultralytics_lines.json", "ultralytics"},
    {"ultralytics_labels", "ultralytics"},
    {"rtmlib.json", "rtmpose"},
    {"rtmpose_inferencer.json", "rtmpose"},
    {"sleap.csv", "sleap"},
    {"sports2d_px_person00.trc", "trc"},
    {"cvat_skeleton.xml", "cvat"},
    {"cvat_points.xml", "cvat"},
    {"kinovea_german.csv", "kinovea"},
    {"kinovea_y_up.csv", "kinovea", 0, 3, 360},
    {"dltdv8_xypts.csv", "dltdv", 0, 3, 0, true},
    {"dltdv5_xypts.csv", "dltdv", 0, 3, 360, true},
};

/// In pixels of the picture of 400 x 300 px that normalised samples were made on.
Eigen::Vector2d px(const imports::ImportedFrame& frame, BodyPart part) {
  const Eigen::Vector2d p = frame[part].p_px;
  return frame.width_px == 1 ? Eigen::Vector2d(400 * p.x() - 0.5, 300 * p.y() - 0.5) : p;
}

imports::ImportOptions options_of(const Sample& sample) {
  imports::ImportOptions options;
  options.y_up_height_px = sample.y_up_height_px;
  if (sample.needs_labels)
    options.labels = {{"hip_r", "pt1"}, {"knee_r", "pt2"}, {"ankle_r", "pt3"},
                      {"hip_l", "pt4"}, {"knee_l", "pt5"}, {"ankle_l", "pt6"}};
  return options;
}

TEST(ImportFormats, EverySampleGivesTheSameFigure) {
  for (const Sample& sample : kSamples) {
    SCOPED_TRACE(sample.file);
    const imports::Detections detections =
        imports::import_points(kFolder / sample.file, options_of(sample));
    EXPECT_EQ(detections.format, sample.format);
    ASSERT_EQ(static_cast<int>(detections.frames.size()), sample.frames);
    for (int i = 0; i < sample.frames; ++i) {
      const imports::ImportedFrame& frame = detections.frames[static_cast<std::size_t>(i)];
      const int f = sample.first_frame + i;
      EXPECT_EQ(frame.frame, f);
      EXPECT_LT((px(frame, BodyPart::knee_r) - Eigen::Vector2d(110 + 4 * f, 160)).norm(), 1e-5);
      if (std::string_view(sample.file) == "cvat_points.xml" && f == 1) continue;
      EXPECT_LT((px(frame, BodyPart::ankle_l) - Eigen::Vector2d(70 + 4 * f, 190)).norm(), 1e-5);
      EXPECT_LT((px(frame, BodyPart::pelvis) - Eigen::Vector2d(100 + 4 * f, 120)).norm(), 1e-5);
    }
  }
}

TEST(ImportFormats, HiddenPointsCountHalfAndAbsentOnesNotAtAll) {
  const imports::Detections cvat = imports::import_points(kFolder / "cvat_skeleton.xml");
  EXPECT_EQ(cvat.frames[0][BodyPart::ankle_l].confidence, 0.5);
  EXPECT_EQ(cvat.frames[0][BodyPart::knee_r].confidence, 1);
  EXPECT_TRUE(cvat.frames[1][BodyPart::knee_l].present());
  EXPECT_FALSE(cvat.frames[2][BodyPart::knee_l].present());
  const imports::Detections coco = imports::import_points(kFolder / "coco_annotations.json");
  EXPECT_EQ(coco.frames[0][BodyPart::ankle_l].confidence, 0.5);
  EXPECT_FALSE(coco.frames[0][BodyPart::toe_l].present());
}

TEST(ImportFormats, NetworksAreNeverAsSureAsAPerson) {
  for (const char* file : {"mediapipe.json", "ultralytics.json", "rtmlib.json"})
    EXPECT_LE(imports::import_points(kFolder / file).frames[0][BodyPart::knee_r].confidence, 0.95);
  const auto mediapipe = imports::import_points(kFolder / "mediapipe_long.csv").frames[2];
  EXPECT_LT((px(mediapipe, BodyPart::toe_r) - Eigen::Vector2d(132, 206)).norm(), 1e-5);
  EXPECT_EQ(mediapipe.width_px, 1);  // shares of the picture
}

TEST(ImportFormats, SeveralPeopleOfANetworkAreToldApart) {
  const TemporaryFolder folder;
  write_file_atomically(
      folder / "two.json",
      R"([{"frame": 0, "keypoints": [], "scores": []},
          {"frame": 4, "keypoints": [)" +
          [] {
            std::string people;
            for (const int size : {1, 3}) {
              people += people.empty() ? "[" : ",[";
              for (int k = 0; k < 17; ++k)
                people += fmt::format("{}[{},{}]", k > 0 ? "," : "", 10 + k, 20 + size * k);
              people += "]";
            }
            return people;
          }() +
          R"(], "scores": [[1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1],
                           [9,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1]]}])");
  const imports::Detections detections = imports::import_points(folder / "two.json");
  EXPECT_EQ(detections.people.size(), 2u);
  ASSERT_EQ(detections.frames.size(), 1u);
  EXPECT_EQ(detections.frames[0].frame, 4);
  EXPECT_EQ(detections.frames[0][BodyPart::ankle_r].p_px.y(), 20 + 3 * 16);  // the larger one
}

TEST(ImportFormats, PointsThatCvatInterpolatedAreLeftOut) {
  const imports::Detections points = imports::import_points(kFolder / "cvat_points.xml");
  EXPECT_FALSE(points.frames[1][BodyPart::ankle_l].present());
}

TEST(ImportFormats, MarkersInMetresOrMillimetresAreRefused) {
  const TemporaryFolder folder;
  std::string trc = read_file(kFolder / "sports2d_px_person00.trc");
  trc.replace(trc.find("\tm\t"), 3, "\tmm\t");
  write_file_atomically(folder / "m.trc", trc);
  EXPECT_ERROR(imports::import_points(folder / "m.trc"),
               "m.trc:3: Units = mm: these are not pixels");
}

TEST(ImportFormats, MalformedFilesNameFileLineAndWhatWasExpected) {
  const struct {
    const char *content, *expected;
  } cases[]{
      {"[{\"image_id\":1,\n\"keypoints\":[1,2]}]", "f:2: expected 17, 26, 133 or 136 points"},
      {"[{\"image_id\":\"x\",\"idx\":1,\n\"keypoints\":[]}]", "f:2: expected 17, 26"},
      {"{\"annotations\":[\n{\"image_id\":1}]}", "f:2: expected an object with 'keypoints'"},
      {"{\"instance_info\":[\n\n{\"instances\":[]}]}", "f:3: expected an object with 'frame_id'"},
      {"track,frame_idx,instance.score,knee_r.x\n", "f:1: expected both 'knee_r.x' and 'knee_r.y'"},
      {"track,frame_idx,knee_r.x,knee_r.y\n,1,2\n", "f:2: 3 cells, but the header has 4"},
      {"track,frame_idx,knee_r.x,knee_r.y\n,one,2,3\n", "f:2: column 2 = 'one': expected a number"},
      {"PathFileType\t4\n", "f:1: expected the five header lines of TRC"},
      {"<annotations>\n<track><points frame=\"1\" points=\"3\"/></track></annotations>",
       "f:2: points = '3': expected one point"},
      {"<annotations>\n<track>", "f:2: not valid XML"},
      {"<annotations></annotations>", "expected CVAT for video 1.1"},
      {"Time,\"knee_r/0/X\",\"knee_r/0/Y\"\n0,1,2\n0,a,2\n", "f:3: Time = '0': expected times"},
      {"Time,\"knee_r/0/X\",\"knee_r/0/Y\"\n0,1,2\n1,a,2\n", "f:3: column 2 = 'a': expected a"},
      {"pt1_cam1_X,pt1_cam1_Y\n1,2\n", "none of its labels (pt1)"},
      {"frame_id,landmark,x,y\n0,LEFT_TAIL,1,2\n", "f:2: 'LEFT_TAIL': expected one of MediaPipe's"},
      {"[{\"landmarks\":\n[{\"x\":1,\"y\":2}]}]", "f:2: expected 33 landmarks (1 here)"},
      {"[[{\"keypoints\":\n{\"x\":[1],\"y\":[1],\"visible\":[1]}}]]", "f:2: expected 17 points"},
      {"[{\"instances\":[{\"keypoints\":\n[[1,2]],\"keypoint_scores\":[1]}]}]",
       "f:2: expected 17, 26 or 133 points"},
      {"frame,knee_r_x,knee_r_y\n-1,2,3\n", "f:2: column 1 = '-1': expected the number of a frame"},
      {"{\"format\":\"stride points\",\"version\":1,\"frames\":[\n{\"frame\":0,\"points\":\n"
       "{\"elbow\":[1,2,3]}}]}",
       "f:3: expected a body part of ours by its name at /frames/0/points/elbow"},
  };
  const TemporaryFolder folder;
  for (const auto& [content, expected] : cases) {
    SCOPED_TRACE(content);
    write_file_atomically(folder / "f", content);
    EXPECT_ERROR(imports::import_points(folder / "f"), expected);
  }
}

/// A copy with a few bytes changed, lost, doubled or moved.
std::string damaged(std::string text, std::mt19937_64& random) {
  const auto at = [&] { return random() % (text.size() + 1); };
  for (std::uint64_t edits = 1 + random() % 4; edits > 0 && !text.empty(); --edits) {
    const std::size_t i = random() % text.size(), n = std::min(random() % 40, text.size() - i);
    switch (random() % 5) {
      case 0:
        text[i] = static_cast<char>(random());
        break;
      case 1:
        text.erase(i, n);
        break;
      case 2:
        text.insert(at(), text.substr(i, n));
        break;
      case 3:
        text.resize(i);
        break;
      default:
        text.replace(i, 1, std::array{"-", "1e308", "nan", ",", "null", "\"", "\n"}[random() % 7]);
    }
  }
  return text;
}

TEST(ImportFormats, DamagedFilesImportOrThrowErrorAndNothingElse) {
  const TemporaryFolder folder;
  std::mt19937_64 random(20240607);
  std::vector<Sample> samples = kSamples;
  for (const char* file :
       {"deeplabcut_analysis.csv", "deeplabcut_labels.csv", "deeplabcut_two_animals.csv"})
    samples.push_back({file, "deeplabcut"});
  int imported = 0, refused = 0;
  for (const Sample& sample : samples) {
    if (std::filesystem::is_directory(kFolder / sample.file)) continue;
    const std::string content = read_file(kFolder / sample.file);
    imports::ImportOptions options = options_of(sample);
    for (int i = 0; i < 120; ++i) {
      options.format = i % 2 == 0 ? sample.format : "";
      std::ofstream(folder / "f") << damaged(content, random);
      try {
        for (const imports::ImportedFrame& frame :
             imports::import_points(folder / "f", options).frames)
          for (const Point& point : frame.points) {
            ASSERT_GE(frame.frame, 0);
            ASSERT_TRUE(point.confidence >= 0 && point.confidence <= 1);
          }
        ++imported;
      } catch (const Error& error) {
        ASSERT_NE(std::string_view(error.what()).find("/f"), std::string_view::npos)
            << error.what();
        ++refused;
      }
    }
  }
  EXPECT_GE(imported, 80);
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace stride
