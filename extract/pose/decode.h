#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace stride::pose {

/// A keypoint in pixels of the network's input.
struct Keypoint {
  Eigen::Vector2d p_px = Eigen::Vector2d::Zero();
  double confidence = 0;
};

/// What a network saw of one person.
struct PosePerson {
  double confidence = 1;
  std::vector<Keypoint> keypoints;  // in the network's order
};

/// `maps`: 1 × K' × h × w with K' ≥ K, a map a keypoint over an input of the given size. The place
/// is the map's highest cell, corrected by the vertex of a parabola through its neighbours: of
/// their logarithms where all are positive, which is exact for a Gaussian. Confidence: the height.
PosePerson decode_heatmaps(const cv::Mat& maps, cv::Size input_px, int keypoints);

/// `x`: 1 × K × m·width, `y`: 1 × K × m·height: how likely each of m places a pixel is (Li et al.,
/// SimCC, 2022). Confidence: the smaller of the two heights.
PosePerson decode_simcc(const cv::Mat& x, const cv::Mat& y, cv::Size input_px, int keypoints);

/// `rows`: 1 × (5 + 3K) × N or 1 × N × (5 + 3K): centre, size and confidence of a box, then x, y
/// and confidence of each keypoint, all in pixels of the input. Boxes below `min_confidence` are
/// dropped, and those that overlap a better one by more than `overlap` of their union.
std::vector<PosePerson> decode_yolo_pose(const cv::Mat& rows, int keypoints, double min_confidence,
                                         double overlap = 0.45);

}  // namespace stride::pose
