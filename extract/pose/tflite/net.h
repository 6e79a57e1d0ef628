#pragma once

#include <opencv2/dnn/dnn.hpp>
#include <string>
#include <vector>

#include "extract/pose/tflite/graph.h"

namespace stride::tflite {

/// The graph as a network of OpenCV. Its input is 1 × channels × height × width, so are all tensors
/// of four sizes; a reshaped tensor has TensorFlow's order. Layers are named as the tensors that
/// they make.
cv::dnn::Net net_of(const Graph& graph);

/// Padding that only a convolution without a border of its own uses becomes that border.
void fold_padding(Graph& graph);

}  // namespace stride::tflite
