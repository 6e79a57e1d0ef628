#include "extract/pose/network_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "extract/pose/blazepose.h"
#include "extract/pose/weights.h"
#include "extract/skeleton/trajectory.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tflite_writer.h"
#include "tests/support/throws.h"

namespace stride::pose {
namespace {

using Eigen::Vector2d;

PoseLandmarks body_at(const Vector2d& p_px, double peak) {
  PoseLandmarks body;
  for (Landmark& landmark : body.landmarks) {
    landmark.p_px = p_px;
    landmark.peak = peak;
  }
  return body;
}

TEST(NetworkPoints, AreAbsentOutsideThePicture) {
  PoseLandmarks body = body_at({100, 50}, 0.9);
  body.landmarks[27].p_px = {100, 121};  // left ankle
  body.landmarks[23].p_px = {-90, 50};   // left hip; the middle of the hips is inside
  const imports::ImportedFrame frame = points_of(body, 7, {200, 120});
  EXPECT_EQ(frame.frame, 7);
  EXPECT_FALSE(frame[BodyPart::ankle_l].present());
  EXPECT_FALSE(frame[BodyPart::hip_l].present());
  EXPECT_TRUE(frame[BodyPart::ankle_r].present());
  EXPECT_EQ(frame[BodyPart::pelvis].p_px, Vector2d(5, 50));
}

TEST(NetworkPoints, AreOfEveryPartButTheHips) {
  PoseLandmarks body = body_at({100, 50}, 0.9);
  for (std::size_t k = 0; k < body.landmarks.size(); ++k)
    body.landmarks[k].p_px.y() = static_cast<double>(k);
  const imports::ImportedFrame frame = points_of(body, 0, {200, 120});
  std::set<double> places;
  for (const BodyPart part : kBodyParts) {
    const bool is_hip = part == BodyPart::hip_r || part == BodyPart::hip_l;
    EXPECT_EQ(frame[part].present(), !is_hip) << name(part);
    if (!is_hip) {
      EXPECT_TRUE(places.insert(frame[part].p_px.y()).second) << name(part);
    }
  }
  EXPECT_EQ(frame[BodyPart::heel_r].p_px.y(), 30);
  EXPECT_EQ(frame[BodyPart::heel_l].p_px.y(), 29);
}

TEST(NetworkPoints, HaveNoLegsWhereOneMayBeBeyondTheSideOfThePicture) {
  for (const auto& [x_px, seen] :
       {std::pair(5.0, false), std::pair(100.0, true), std::pair(190.0, false)}) {
    PoseLandmarks body = body_at({x_px, 50}, 0.9);
    body.next.size_px = 100;
    const imports::ImportedFrame frame = points_of(body, 0, {200, 120});
    EXPECT_TRUE(frame[BodyPart::pelvis].present());
    EXPECT_TRUE(frame[BodyPart::head].present());
    for (const BodyPart part : {BodyPart::knee_r, BodyPart::ankle_l, BodyPart::toe_r})
      EXPECT_EQ(frame[part].present(), seen) << x_px;
  }
}

TEST(NetworkPoints, AreTheLessCertainTheLowerTheirHeatMap) {
  const auto knee = [](double peak) {
    return points_of(body_at({100, 50}, peak), 0, {200, 120})[BodyPart::knee_r].confidence;
  };
  EXPECT_GT(knee(0.9), 1.5 * knee(0.5));
  EXPECT_GT(knee(0.0), 0);
  EXPECT_LT(knee(1.0), 0.99);  // a click's is 1
}

TEST(Weights, OfAnotherKindAreRefusedByName) {
  const TemporaryFolder folder;
  TfliteWriter writer;
  const int in = writer.tensor("input_1", {1, 256, 256, 3}),
            out = writer.tensor("Identity", {1, 196608});
  writer.operation(22, {in}, out);
  const auto file = folder / "pose_landmark_heavy.tflite";
  std::ofstream(file, std::ios::binary) << writer.file({in}, {out});
  EXPECT_ERROR(LandmarkNetwork(file), "its output Identity is [1, 196608]");
  EXPECT_ERROR(weights_at(file), "must lie beside it");
  std::ofstream(file, std::ios::binary) << "not a network";
  EXPECT_ERROR(LandmarkNetwork(file), "setup.sh --pose");
  EXPECT_ERROR(weights_at(file), "is a text, a pose network (.tflite, or .onnx) is needed");
}

/// With the network itself, where it is installed.
TEST(NetworkPoints, LieOnTheLegsOfARunner) {
  if (!installed_weights()) GTEST_SKIP() << how_to_install_weights();
  const std::filesystem::path videos = std::filesystem::path(STRIDE_SOURCE_DIR) / "videos";
  const NetworkPoints points = network_points(videos / "small.mp4");
  const Trajectory truth = load_trajectory(videos / "small.truth.csv");
  EXPECT_EQ(points.followed.frames, 96);
  EXPECT_EQ(points.followed.lost, 0);
  ASSERT_EQ(points.detections.frames.size(), truth.frames.size());
  double hips = 0, knees = 0;
  for (std::size_t i = 0; i < truth.frames.size(); ++i) {
    const auto& found = points.detections.frames[i];
    const auto distance = [&](BodyPart a, BodyPart b) {
      return (found[a].p_px - truth.frames[i][b].p_px).norm();
    };
    hips += distance(BodyPart::pelvis, BodyPart::pelvis) / 96;
    knees += std::min(distance(BodyPart::knee_r, BodyPart::knee_r) +
                          distance(BodyPart::knee_l, BodyPart::knee_l),
                      distance(BodyPart::knee_r, BodyPart::knee_l) +
                          distance(BodyPart::knee_l, BodyPart::knee_r)) /
             2 / 96;
  }
  EXPECT_LT(hips, 0.04 * 52);  // of the leg
  EXPECT_LT(knees, 0.06 * 52);
}

}  // namespace
}  // namespace stride::pose
