#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <opencv2/dnn/dnn.hpp>
#include <string>
#include <vector>

#include "extract/pose/crop.h"

namespace stride::pose {

/// Somebody whom the detector saw.
struct Candidate {
  Crop crop;
  double score = 0;  // 0 … 1
};

/// One landmark of a body. Its place is where the heat map is heaviest; where the map shows
/// nothing, that of the network's regression.
struct Landmark {
  Eigen::Vector2d p_px = Eigen::Vector2d::Zero();          // in the image
  Eigen::Vector2d regressed_px = Eigen::Vector2d::Zero();  // by the regression alone
  double visibility = 0;                                   // the network's word, 0 … 1
  double peak = 0;                                         // highest probability of the heat map
  double width_px = 0;  // standard deviation of the heat map around its centre, of the image
};

inline constexpr int kLandmarks = 33;

struct PoseLandmarks {
  double presence = 0;  // that the crop shows a person, 0 … 1
  std::array<Landmark, kLandmarks> landmarks;
  Crop next;  // the crop of the same person on the next frame
};

/// BlazePose (Bazarevsky et al., 2020) as Google's MediaPipe publishes it, in OpenCV's dnn module.
/// Both read a .tflite file and run the network on sin(0), sin(1), … at once: they throw Error
/// where the file is another or OpenCV computes something else than it should.
class PersonDetector {
 public:
  explicit PersonDetector(const std::filesystem::path& file);
  /// Everybody in a part of an image, best first.
  std::vector<Candidate> find(const cv::Mat& bgr, const Crop& region);

 private:
  cv::dnn::Net net_;
  std::vector<Eigen::Vector2d> anchors_;  // in shares of the crop
};

class LandmarkNetwork {
 public:
  explicit LandmarkNetwork(const std::filesystem::path& file);
  /// The body of the person around whom the crop lies.
  PoseLandmarks look(const cv::Mat& bgr, const Crop& crop);

 private:
  cv::dnn::Net net_;
};

}  // namespace stride::pose
