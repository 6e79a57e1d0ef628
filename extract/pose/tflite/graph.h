#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace stride::tflite {

/// Sizes of a tensor as TensorFlow has them: batch, height, width, channels, or fewer.
using Shape = std::vector<int>;

/// Their product: the number of elements.
inline std::size_t elements(const Shape& shape) {
  std::size_t product = 1;
  for (const int size : shape) product *= static_cast<std::size_t>(size);
  return product;
}

enum class Operation {
  convolution,
  depthwise_convolution,
  addition,
  padding,
  bilinear_resize,
  max_pool,
  reshape,
  sigmoid,
  depth_to_space,
  concatenation
};

/// What is computed of some tensors. Only what the operation needs is set.
struct Node {
  Operation operation = Operation::addition;
  std::string name;         // of the tensor that it makes
  std::vector<int> inputs;  // indices of tensors; constants are in the fields below
  int output = -1;
  bool relu6 = false;  // the result is cut to [0, 6]

  int kernel_y = 0, kernel_x = 0, stride_y = 1, stride_x = 1;  // convolutions and pooling
  std::array<int, 4> border{};          // zeros added at top, bottom, left, right
  std::array<int, 2> channel_border{};  // of padding: before, after
  std::vector<float> weights;  // convolution: outputs × inputs × kernel_y × kernel_x; depthwise:
                               // channels × kernel_y × kernel_x
  std::vector<float> bias;     // one an output channel
  int block = 0, axis = 0;     // depth_to_space (DCR); concatenation, as in Shape
};

/// A network as a file tells it. Every shape has been checked against its operation.
struct Graph {
  std::vector<Shape> shapes;       // of all tensors
  std::vector<std::string> names;  // likewise
  std::vector<Node> nodes;         // in an order in which they can be computed
  int input = -1;                  // tensor
  std::vector<int> outputs;        // tensors

  const Shape& shape(int tensor) const { return shapes[static_cast<std::size_t>(tensor)]; }
};

}  // namespace stride::tflite
