#pragma once

#include <array>
#include <opencv2/dnn/dnn.hpp>
#include <vector>

namespace stride::tflite {

/// A convolution of each channel with a kernel of its own, then ReLU6 if `relu6`. OpenCV 4.6 takes
/// half of a pose network's time for these; this is five to ten times faster on small images.
struct Depthwise {
  int kernel_y = 0, kernel_x = 0, stride_y = 1, stride_x = 1;
  std::array<int, 4> border{};  // zeros at top, bottom, left, right
  bool relu6 = false;
  std::vector<float> weights;  // channels × kernel_y × kernel_x
  std::vector<float> bias;     // channels
};

/// `image` and the result: 1 × channels × height × width, floats.
void apply(const Depthwise& convolution, const cv::Mat& image, cv::Mat& result);

/// The same as a layer of a network of OpenCV: its type, after registering it once.
const char* depthwise_layer_type();
cv::dnn::LayerParams layer_params(const Depthwise& convolution);

}  // namespace stride::tflite
