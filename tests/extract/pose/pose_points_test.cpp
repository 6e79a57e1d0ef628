#include "extract/pose/pose_points.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "extract/io/file.h"
#include "extract/pose/network.h"
#include "extract/pose/onnx_writer.h"
#include "extract/video/video_writer.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

constexpr int kMapWidth = 64, kMapHeight = 48;
using Integers = std::vector<std::int64_t>;
const Integers kOneByOne{1, 1};

/// Keypoint k is where channel k of the picture stands out from the two others: a 1 × 1
/// convolution to one map each, so that a spot of colour is its own heat map.
OnnxModel heatmap_network() {
  OnnxModel model;
  model.name = "spots";
  model.opset = 4;  // the last in which Reshape has its shape as an attribute
  model.inputs = {{"input", {1, 3, kMapHeight, kMapWidth}}};
  model.constants = {{"weight", {3, 3, 1, 1}, {1, -1, -1, -1, 1, -1, -1, -1, 1}}};
  model.nodes = {{"Conv", {"input", "weight"}, {"maps"}, {{"kernel_shape", kOneByOne}}}};
  model.outputs = {{"maps", {1, 3, kMapHeight, kMapWidth}}};
  return model;
}

/// The same, and then the highest of each column and of each row.
OnnxModel simcc_network() {
  OnnxModel model = heatmap_network();
  const Integers column{kMapHeight, 1}, row{1, kMapWidth}, x{1, 3, kMapWidth}, y{1, 3, kMapHeight};
  model.nodes.push_back({"MaxPool", {"maps"}, {"columns"}, {{"kernel_shape", column}}});
  model.nodes.push_back({"MaxPool", {"maps"}, {"rows"}, {{"kernel_shape", row}}});
  model.nodes.push_back({"Reshape", {"columns"}, {"simcc_x"}, {{"shape", x}}});
  model.nodes.push_back({"Reshape", {"rows"}, {"simcc_y"}, {{"shape", y}}});
  model.outputs = {{"simcc_x", x}, {"simcc_y", y}};
  return model;
}

/// A person at every red pixel, in a box of 20 × 30, with three keypoints at given offsets.
const Eigen::Vector2d kWays[]{{0, -12}, {3, 2}, {-4, 11}};
OnnxModel yolo_network() {
  std::vector<float> before, after;  // the channels before and after the confidence of the box
  const auto fill = [](std::vector<float>& to, auto value) {
    for (int y = 0; y < kMapHeight; ++y)
      for (int x = 0; x < kMapWidth; ++x) to.push_back(static_cast<float>(value(x, y)));
  };
  fill(before, [](int x, int) { return x; });
  fill(before, [](int, int y) { return y; });
  fill(before, [](int, int) { return 20; });
  fill(before, [](int, int) { return 30; });
  for (const Eigen::Vector2d& displacement : kWays) {
    fill(after, [&](int x, int) { return x + displacement.x(); });
    fill(after, [&](int, int y) { return y + displacement.y(); });
    fill(after, [&](int, int) { return 0.9; });
  }
  OnnxModel model = heatmap_network();
  const Integers rows{1, 14, kMapWidth * kMapHeight};
  model.constants = {{"weight", {1, 3, 1, 1}, {1, -1, -1}},
                     {"before", {1, 4, kMapHeight, kMapWidth}, before},
                     {"after", {1, 9, kMapHeight, kMapWidth}, after}};
  model.nodes.push_back(
      {"Concat", {"before", "maps", "after"}, {"all"}, {{"axis", std::int64_t{1}}}});
  model.nodes.push_back({"Reshape", {"all"}, {"rows"}, {{"shape", rows}}});
  model.outputs = {{"rows", rows}};
  return model;
}

/// The expected output of the three networks above for the input of the self-check.
float map_of(const cv::Mat& input, int k, int y, int x) {
  float sum = 0;
  for (int c = 0; c < 3; ++c) {
    const int place[]{0, c, y, x};
    sum += (c == k ? 1.0F : -1.0F) * input.at<float>(place);
  }
  return sum;
}
cv::Mat expected_maps() {
  const cv::Mat input = pose::self_check_input(kMapWidth, kMapHeight);
  const int shape[]{1, 3, kMapHeight, kMapWidth};
  cv::Mat maps(4, shape, CV_32F);
  for (int k = 0; k < 3; ++k)
    for (int y = 0; y < kMapHeight; ++y)
      for (int x = 0; x < kMapWidth; ++x) {
        const int place[]{0, k, y, x};
        maps.at<float>(place) = map_of(input, k, y, x);
      }
  return maps;
}

std::string sidecar(const std::string& decoder, const std::vector<double>& values,
                    const std::string& more = "") {
  return fmt::format(
      "decoder = \"{}\"\nkeypoints = [\"right knee\", \"left knee\", \"pt3\"]\n{}\n"
      "[input]\nwidth = {}\nheight = {}\ncolour = \"rgb\"\nmean = [0, 0, 0]\n"
      "std = [255, 255, 255]\n\n[parts]\npelvis = \"pt3\"\n\n[self-check]\nvalues = [{}]\n",
      decoder, more, kMapWidth, kMapHeight, fmt::join(values, ", "));
}

struct Model {
  TemporaryFolder folder;
  pose::PoseNetwork load() {
    return pose::PoseNetwork(folder / "m.onnx", pose::load_pose_sidecar(folder / "m.toml"));
  }
  void write(const std::string& bytes, const std::string& toml) {
    write_file_atomically(folder / "m.onnx", bytes);
    write_file_atomically(folder / "m.toml", toml);
  }
};

/// Gaussian spots of red, green and blue (3 px wide, BGR) at the given places.
cv::Mat picture(cv::Size size, const std::vector<Eigen::Vector2d>& places, double level = 255) {
  cv::Mat image(size, CV_8UC3, cv::Scalar::all(0));
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (int k = 0; k < static_cast<int>(places.size()); ++k) {
        const double square =
            (places[static_cast<std::size_t>(k)] - Eigen::Vector2d(x, y)).squaredNorm();
        image.at<cv::Vec3b>(y, x)[2 - k] = cv::saturate_cast<uchar>(level * std::exp(-square / 18));
      }
  return image;
}

const std::vector<Eigen::Vector2d> kPlaces{{20.3, 15.8}, {44.6, 12.25}, {31.4, 36.4}};

TEST(Pose, HeatMapsGiveTheSpotBetweenThePixels) {
  Model model;
  model.write(to_onnx(heatmap_network()),
              sidecar("heatmap", pose::self_check_values({expected_maps()}, 40)));
  const auto people = model.load().find(picture({kMapWidth, kMapHeight}, kPlaces),
                                        {-0.5, -0.5, kMapWidth, kMapHeight});
  ASSERT_EQ(people.size(), 1u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR((people[0].keypoints[k].p_px - kPlaces[k]).norm(), 0, 0.05) << k;
    EXPECT_NEAR(people[0].keypoints[k].confidence, 1, 0.03);
  }
}

TEST(Pose, ALargerPictureIsMadeSmallerAndABoxLarger) {
  Model model;
  model.write(to_onnx(heatmap_network()),
              sidecar("heatmap", pose::self_check_values({expected_maps()}, 40)));
  pose::PoseNetwork network = model.load();
  cv::Mat twice;
  const cv::Mat image = picture({kMapWidth, kMapHeight}, kPlaces);
  cv::resize(image, twice, {}, 2, 2, cv::INTER_LINEAR);
  const auto small = network.find(twice, {-0.5, -0.5, 2 * kMapWidth, 2 * kMapHeight});
  const auto box = network.find(image, {13.5, 9.5, 32, 12});  // wider than the input's 4 : 3
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector2d place = 2 * kPlaces[k] + Eigen::Vector2d::Constant(0.5);
    EXPECT_NEAR((small[0].keypoints[k].p_px - place).norm(), 0, 0.2) << k;
  }
  EXPECT_NEAR((box[0].keypoints[0].p_px - kPlaces[0]).norm(), 0, 0.1);
}

TEST(Pose, SimCCGivesTheBestColumnAndRow) {
  cv::Mat maps = expected_maps();
  const int across[]{1, 3, kMapWidth}, down[]{1, 3, kMapHeight};
  cv::Mat x(3, across, CV_32F), y(3, down, CV_32F);
  for (int k = 0; k < 3; ++k) {
    const cv::Mat map(kMapHeight, kMapWidth, CV_32F, maps.ptr<float>(0, k));
    cv::Mat columns, rows;
    cv::reduce(map, columns, 0, cv::REDUCE_MAX);
    cv::reduce(map, rows, 1, cv::REDUCE_MAX);
    std::copy_n(columns.ptr<float>(), kMapWidth, x.ptr<float>(0, k));
    std::copy_n(rows.ptr<float>(), kMapHeight, y.ptr<float>(0, k));
  }
  Model model;
  model.write(to_onnx(simcc_network()), sidecar("simcc", pose::self_check_values({x, y}, 50),
                                                "outputs = [\"simcc_x\", \"simcc_y\"]"));
  const auto people = model.load().find(picture({kMapWidth, kMapHeight}, kPlaces),
                                        {-0.5, -0.5, kMapWidth, kMapHeight});
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(people[0].keypoints[k].p_px, Eigen::Vector2d(kPlaces[k].array().round())) << k;
}

TEST(Pose, SimCCPlacesLieBetweenPixels) {
  const int shape[]{1, 1, 16};
  cv::Mat x(3, shape, CV_32F, cv::Scalar(0)), y = x.clone();
  x.ptr<float>(0, 0)[13] = 0.8F;
  y.ptr<float>(0, 0)[7] = 0.6F;
  const pose::Keypoint keypoint = pose::decode_simcc(x, y, {8, 8}, 1).keypoints[0];
  EXPECT_EQ(keypoint.p_px, Eigen::Vector2d(6.5, 3.5));
  EXPECT_FLOAT_EQ(static_cast<float>(keypoint.confidence), 0.6F);
}

TEST(Pose, YoloGivesEverybodyOnce) {
  const cv::Mat input = pose::self_check_input(kMapWidth, kMapHeight);
  const int shape[]{1, 14, kMapWidth * kMapHeight};
  cv::Mat rows(3, shape, CV_32F);
  for (int y = 0; y < kMapHeight; ++y)
    for (int x = 0; x < kMapWidth; ++x) {
      const int cell = y * kMapWidth + x;
      const auto set = [&](int row, double value) {
        rows.ptr<float>(0, row)[cell] = static_cast<float>(value);
      };
      set(0, x), set(1, y), set(2, 20), set(3, 30), set(4, map_of(input, 0, y, x));
      for (int k = 0; k < 3; ++k)
        set(5 + 3 * k, x + kWays[k].x()), set(6 + 3 * k, y + kWays[k].y()), set(7 + 3 * k, 0.9);
    }
  Model model;
  model.write(to_onnx(yolo_network()), sidecar("yolo-pose", pose::self_check_values({rows}, 60)));
  cv::Mat image = picture({kMapWidth, kMapHeight}, {{16, 24}});
  cv::max(image, picture({kMapWidth, kMapHeight}, {{48, 20}}, 200), image);
  const auto people = model.load().find(image, {-0.5, -0.5, kMapWidth, kMapHeight});
  ASSERT_EQ(people.size(), 2u);
  EXPECT_NEAR(people[1].confidence, 200 / 255.0, 0.01);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR((people[0].keypoints[k].p_px - Eigen::Vector2d(16, 24) - kWays[k]).norm(), 0, 1e-4);
    EXPECT_NEAR((people[1].keypoints[k].p_px - Eigen::Vector2d(48, 20) - kWays[k]).norm(), 0, 1e-4);
  }
}

TEST(Pose, AFailedSelfCheckIsRefused) {
  Model model;
  std::vector<double> values = pose::self_check_values({expected_maps()}, 40);
  values[17] += 0.01;
  model.write(to_onnx(heatmap_network()), sidecar("heatmap", values));
  EXPECT_ERROR(model.load(), "m.onnx: the self-check failed: value 17 of 40 is");
  model.write("no network", sidecar("heatmap", values));
  EXPECT_ERROR(model.load(), "m.onnx: OpenCV 4.6.0 cannot read it");
}

TEST(Pose, ASidecarSaysWhatItLacks) {
  const TemporaryFolder folder;
  const auto load = [&](const std::string& toml) {
    write_file_atomically(folder / "m.toml", toml);
    return pose::load_pose_sidecar(folder / "m.toml");
  };
  const std::vector<double> values = pose::self_check_values({expected_maps()}, 20);
  const std::string good = sidecar("heatmap", values);
  EXPECT_EQ(load(good).parts.at("pelvis"), "pt3");
  EXPECT_ERROR(load(sidecar("heatmap", {1, 2})), "m.toml: [self-check] values has 2 numbers");
  EXPECT_ERROR(load(sidecar("heatmap", std::vector<double>(20, 1))), "would prove nothing");
  EXPECT_ERROR(load(sidecar("tea", values)), "decoder = tea: must be heatmap, simcc or yolo-pose");
  EXPECT_ERROR(load(sidecar("simcc", values)), "simcc needs the names of two outputs");
  EXPECT_ERROR(load(good + "tolerence = 1\n"), "key 'self-check.tolerence' is not known");
  EXPECT_ERROR(load("decoder = \"heatmap\"\n"), "keypoints is missing");
}

/// Three spots that pass through a larger picture, found in a box that follows them.
TEST(Pose, ABoxFollowsThePersonThroughTheVideo) {
  Model model;
  model.write(to_onnx(heatmap_network()),
              sidecar("heatmap", pose::self_check_values({expected_maps()}, 40)));
  const auto place = [](int frame, std::size_t k) {
    return Eigen::Vector2d(kPlaces[k] + Eigen::Vector2d(10 + 6 * frame, 20));
  };
  {
    video::VideoWriter writer(model.folder / "v.mp4", 30);
    for (int frame = 0; frame < 20; ++frame)
      writer.write(picture({200, 100}, {place(frame, 0), place(frame, 1), place(frame, 2)}));
    writer.finish();
  }
  pose::PoseOptions options;
  options.model = model.folder / "m.onnx";
  options.box_px = cv::Rect2d(14, 24, 56, 40);
  const imports::Detections detections = pose::pose_points(model.folder / "v.mp4", options);
  EXPECT_EQ(detections.format, "pose");
  ASSERT_EQ(detections.frames.size(), 20u);
  // To a pixel: the codec halves the resolution of colours.
  for (const imports::ImportedFrame& frame : detections.frames) {
    EXPECT_NEAR((frame[BodyPart::knee_r].p_px - place(frame.frame, 0)).norm(), 0, 1);
    EXPECT_NEAR((frame[BodyPart::knee_l].p_px - place(frame.frame, 1)).norm(), 0, 1);
    EXPECT_NEAR((frame[BodyPart::pelvis].p_px - place(frame.frame, 2)).norm(), 0, 1);
  }
}

}  // namespace
}  // namespace stride
