#pragma once

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <opencv2/dnn/dnn.hpp>
#include <vector>

#include "extract/pose/decode.h"
#include "extract/pose/sidecar.h"

namespace stride::pose {

/// A user's pose model through OpenCV's dnn module, on one core or as many as OpenCV takes.
class PoseNetwork {
 public:
  /// Reads the ONNX file and runs the self-check. Throws Error naming the file and the cure where
  /// OpenCV cannot read it, or reads it and computes something else than the sidecar says.
  PoseNetwork(const std::filesystem::path& onnx, PoseSidecar sidecar);

  /// Everybody in a region of an image (BGR, 8 bit), which may reach beyond it: at most one by
  /// heat maps and simcc. Places in pixels of the image.
  std::vector<PosePerson> find(const cv::Mat& bgr, const cv::Rect2d& region);

  const PoseSidecar& sidecar() const { return sidecar_; }

 private:
  std::vector<cv::Mat> run(const cv::Mat& input);
  void check_itself();

  std::string file_;
  PoseSidecar sidecar_;
  cv::dnn::Net net_;
};

/// The input of the self-check, 1 × 3 × height × width: sin(i) for i = 0, 1, … in that order. The
/// sidecar has N values of what comes out, taken from all outputs one after the other, T numbers
/// in all, at the places ⌊k T / N⌋ for k = 0 … N − 1.
cv::Mat self_check_input(int width_px, int height_px);
std::vector<double> self_check_values(const std::vector<cv::Mat>& outputs, std::size_t count);

}  // namespace stride::pose
