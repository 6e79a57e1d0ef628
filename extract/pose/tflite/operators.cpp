#include "extract/pose/tflite/operators.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>

namespace stride::tflite {
namespace {

// Numbers of the schema's BuiltinOperator.
enum Code {
  kAdd = 0,
  kConcatenation = 2,
  kConv2d = 3,
  kDepthwiseConv2d = 4,
  kDepthToSpace = 5,
  kDequantize = 6,
  kLogistic = 14,
  kMaxPool2d = 17,
  kReshape = 22,
  kResizeBilinear = 23,
  kPad = 34,
  kDensify = 124
};

/// An operator while it is read.
struct Record {
  FlatTable table;
  TfliteTensors& tensors;
  std::vector<int> inputs;
  Node node;

  const Shape& in(std::size_t i) const { return tensors.shape(inputs[i]); }
  const Shape& out() const { return tensors.shape(node.output); }

  template <typename T>
  T option(int field, T otherwise) const {
    const std::optional<FlatTable> options = table.table(4);
    return options ? options->scalar<T>(field, otherwise) : otherwise;
  }
};

void require_shape(const Record& r, const Shape& expected) {
  require(r.out() == expected, "{} is {}: must be {} by what it is computed from", r.node.name,
          r.out(), expected);
}

void require_inputs(const Record& r, std::size_t count) {
  require(r.inputs.size() == count, "{} has {} inputs: must have {}", r.node.name, r.inputs.size(),
          count);
}

/// Batch 1, height, width, channels.
const Shape& image(const Record& r, std::size_t input) {
  const Shape& shape = r.in(input);
  require(shape.size() == 4 && shape[0] == 1, "{}: its input is {}: must be 1 × height × width × C",
          r.node.name, shape);
  return shape;
}

void read_activation(Record& r, int field) {
  const auto activation = r.option<std::int8_t>(field, 0);
  require(activation == 0 || activation == 3,
          "{}: fused activation {}: only none (0) and RELU6 (3) are supported", r.node.name,
          activation);
  r.node.relu6 = activation == 3;
}

/// Strides, border and the size of what comes out of a window that moves over the image.
void read_window(Record& r, int channels) {
  Node& node = r.node;
  const Shape& from = image(r, 0);
  const auto padding = r.option<std::int8_t>(0, 0);  // 0 SAME, 1 VALID
  node.stride_x = r.option<std::int32_t>(1, 0);
  node.stride_y = r.option<std::int32_t>(2, 0);
  require(
      std::min(node.stride_x, node.stride_y) >= 1 && std::max(node.stride_x, node.stride_y) <= 8,
      "{}: strides {} and {}: must be 1 to 8", node.name, node.stride_x, node.stride_y);
  require(std::max(node.kernel_x, node.kernel_y) <= 64, "{}: a kernel of {} × {}: at most 64",
          node.name, node.kernel_y, node.kernel_x);
  Shape to{1, 0, 0, channels};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const int kernel = axis == 0 ? node.kernel_y : node.kernel_x,
              stride = axis == 0 ? node.stride_y : node.stride_x, size = from[1 + axis];
    int border = 0;
    if (padding == 0)
      border = std::max(((size + stride - 1) / stride - 1) * stride + kernel - size, 0);
    require(size + border >= kernel, "{}: a kernel of {} over {}", node.name, kernel, size);
    node.border[2 * axis] = border / 2;
    node.border[2 * axis + 1] = border - border / 2;
    to[1 + axis] = (size + border - kernel) / stride + 1;
  }
  require_shape(r, to);
}

/// Weights as the network has them, outputs × y × x × inputs, with the inputs moved to the front.
std::vector<float> inputs_first(const std::vector<float>& weights, const Shape& shape) {
  const auto outputs = static_cast<std::size_t>(shape[0]),
             inputs = static_cast<std::size_t>(shape[3]),
             cells = static_cast<std::size_t>(shape[1]) * static_cast<std::size_t>(shape[2]);
  std::vector<float> result(weights.size());
  for (std::size_t o = 0; o < outputs; ++o)
    for (std::size_t cell = 0; cell < cells; ++cell)
      for (std::size_t i = 0; i < inputs; ++i)
        result[(o * inputs + i) * cells + cell] = weights[(o * cells + cell) * inputs + i];
  return result;
}

void read_convolution(Record& r, bool depthwise) {
  require_inputs(r, 3);
  Node& node = r.node;
  const Shape& weights = r.in(1);
  const int channels = image(r, 0)[3];
  require(weights.size() == 4 && weights[3] == channels && (!depthwise || weights[0] == 1),
          "{}: weights of {} for {} channels", node.name, weights, channels);
  const int outputs = depthwise ? channels : weights[0];
  node.operation = depthwise ? Operation::depthwise_convolution : Operation::convolution;
  node.kernel_y = weights[1];
  node.kernel_x = weights[2];
  const int dilation = depthwise ? 5 : 4;
  if (depthwise)
    require(r.option<std::int32_t>(3, 1) == 1, "{}: depth multiplier {}: must be 1", node.name,
            r.option<std::int32_t>(3, 1));
  for (const int field : {dilation, dilation + 1})
    require(r.option<std::int32_t>(field, 1) == 1, "{}: dilation {}: must be 1", node.name,
            r.option<std::int32_t>(field, 1));
  read_activation(r, depthwise ? 4 : 3);
  read_window(r, outputs);
  node.weights = inputs_first(r.tensors.floats(r.inputs[1]), weights);
  node.bias = r.tensors.floats(r.inputs[2]);
  require(node.bias.size() == static_cast<std::size_t>(outputs), "{}: {} biases for {} channels",
          node.name, node.bias.size(), outputs);
  node.inputs = {r.inputs[0]};
}

void read_addition(Record& r) {
  require_inputs(r, 2);
  require(r.in(0) == r.in(1) && !r.tensors.is_constant(r.inputs[0]) &&
              !r.tensors.is_constant(r.inputs[1]),
          "{}: adds {} and {}: must be computed and alike", r.node.name, r.in(0), r.in(1));
  require_shape(r, r.in(0));
  read_activation(r, 0);
  r.node.operation = Operation::addition;
}

void read_padding(Record& r) {
  require_inputs(r, 2);
  const Shape from = image(r, 0);
  const std::vector<int> border = r.tensors.integers(r.inputs[1]);
  require(border.size() == 8 && border[0] == 0 && border[1] == 0 &&
              std::ranges::all_of(border, [](int n) { return n >= 0 && n <= 4096; }),
          "{}: pads by {}: must be four pairs, none of the batch", r.node.name, border);
  require_shape(r, {1, from[1] + border[2] + border[3], from[2] + border[4] + border[5],
                    from[3] + border[6] + border[7]});
  r.node.operation = Operation::padding;
  r.node.border = {border[2], border[3], border[4], border[5]};
  r.node.channel_border = {border[6], border[7]};
  r.node.inputs = {r.inputs[0]};
}

void read_resize(Record& r) {
  require_inputs(r, 2);
  const std::vector<int> size = r.tensors.integers(r.inputs[1]);
  const Shape& from = image(r, 0);
  require(size.size() == 2, "{}: resizes to {}: must be two sizes", r.node.name, size);
  require_shape(r, {1, size[0], size[1], from[3]});
  require(!r.option<bool>(2, false) && r.option<bool>(3, false),
          "{}: only resizing with half-pixel centres is supported", r.node.name);
  r.node.operation = Operation::bilinear_resize;
  r.node.inputs = {r.inputs[0]};
}

void read_max_pool(Record& r) {
  require_inputs(r, 1);
  r.node.operation = Operation::max_pool;
  r.node.kernel_x = r.option<std::int32_t>(3, 0);
  r.node.kernel_y = r.option<std::int32_t>(4, 0);
  require(std::min(r.node.kernel_x, r.node.kernel_y) >= 1, "{}: a kernel of {} × {}", r.node.name,
          r.node.kernel_y, r.node.kernel_x);
  read_activation(r, 5);
  read_window(r, image(r, 0)[3]);
}

void read_reshape(Record& r) {
  require(r.inputs.size() == 1 || r.inputs.size() == 2, "{} has {} inputs: must have 1 or 2",
          r.node.name, r.inputs.size());
  require(elements(r.in(0)) == elements(r.out()) && r.out().size() < 4,
          "{}: {} becomes {}: must have as many numbers and fewer than four sizes", r.node.name,
          r.in(0), r.out());
  r.node.operation = Operation::reshape;
  r.node.inputs = {r.inputs[0]};
}

void read_sigmoid(Record& r) {
  require_inputs(r, 1);
  require_shape(r, r.in(0));
  r.node.operation = Operation::sigmoid;
}

void read_depth_to_space(Record& r) {
  require_inputs(r, 1);
  const Shape& from = image(r, 0);
  const int block = r.option<std::int32_t>(0, 0);
  require(block >= 1 && block <= 64 && from[3] % (block * block) == 0,
          "{}: blocks of {} from {} channels", r.node.name, block, from[3]);
  require_shape(r, {1, from[1] * block, from[2] * block, from[3] / (block * block)});
  r.node.operation = Operation::depth_to_space;
  r.node.block = block;
}

void read_concatenation(Record& r) {
  require(!r.inputs.empty(), "{} has no inputs", r.node.name);
  Shape whole = r.in(0);
  int axis = r.option<std::int32_t>(0, 0);
  const auto sizes = static_cast<int>(whole.size());
  if (axis < 0) axis += sizes;
  require(axis >= 0 && axis < sizes, "{}: joins along size {} of {}", r.node.name, axis, sizes);
  const auto along = static_cast<std::size_t>(axis);
  for (std::size_t i = 1; i < r.inputs.size(); ++i) {
    Shape part = r.in(i);
    require(part.size() == whole.size(), "{}: joins {} and {}", r.node.name, whole, part);
    std::swap(whole[along], part[along]);
    const int length = whole[along];
    whole[along] = part[along];
    require(part == whole, "{}: joins {} and {}", r.node.name, r.in(0), r.in(i));
    whole[along] += length;
  }
  require_shape(r, whole);
  read_activation(r, 1);
  r.node.operation = Operation::concatenation;
  r.node.axis = axis;
}

}  // namespace

std::optional<Node> node_of(int code, const FlatTable& table, TfliteTensors& tensors) {
  const std::vector<int> outputs = table.vector(2, 4).scalars<int>();
  require(outputs.size() == 1, "operator {} has {} outputs: must have one", code, outputs.size());
  Record r{table, tensors, table.vector(1, 4).scalars<int>(), {}};
  for (const int input : r.inputs) tensors.shape(input);  // is there
  r.node.output = outputs.front();
  r.node.name = tensors.name(r.node.output);
  r.node.inputs = r.inputs;
  switch (code) {
    case kDequantize:
    case kDensify:
      require_inputs(r, 1);
      tensors.rename_constant(r.inputs[0], r.node.output);
      return std::nullopt;
    case kConv2d:
      read_convolution(r, false);
      break;
    case kDepthwiseConv2d:
      read_convolution(r, true);
      break;
    case kAdd:
      read_addition(r);
      break;
    case kPad:
      read_padding(r);
      break;
    case kResizeBilinear:
      read_resize(r);
      break;
    case kMaxPool2d:
      read_max_pool(r);
      break;
    case kReshape:
      read_reshape(r);
      break;
    case kLogistic:
      read_sigmoid(r);
      break;
    case kDepthToSpace:
      read_depth_to_space(r);
      break;
    case kConcatenation:
      read_concatenation(r);
      break;
    default:
      throw Error(fmt::format(
          "operator {} (of TensorFlow Lite's BuiltinOperator) makes {}: it is not supported", code,
          r.node.name));
  }
  return std::move(r.node);
}

}  // namespace stride::tflite
