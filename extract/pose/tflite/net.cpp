#include "extract/pose/tflite/net.h"

#include <algorithm>
#include <map>

#include "extract/pose/tflite/depthwise.h"

namespace stride::tflite {
namespace {

using cv::dnn::DictValue;
using cv::dnn::LayerParams;

DictValue list(const std::vector<int>& values) {
  return DictValue::arrayInt(values.data(), static_cast<int>(values.size()));
}

cv::Mat blob(const std::vector<float>& values, const std::vector<int>& sizes) {
  cv::Mat blob(sizes, CV_32F);
  std::ranges::copy(values, blob.ptr<float>());
  return blob;
}

/// Adds layers to a network; tensors are known by the layer that makes them.
struct Builder {
  const Graph& graph;
  cv::dnn::Net net;
  std::map<int, int> layer_of{};  // tensor → layer

  int add(const std::string& name, const std::string& type, LayerParams params,
          const std::vector<int>& from) {
    const int layer = net.addLayer(name, type, params);
    for (std::size_t i = 0; i < from.size(); ++i)
      net.connect(from[i], 0, layer, static_cast<int>(i));
    return layer;
  }

  std::vector<int> layers(const Node& node) const {
    std::vector<int> layers;
    for (const int input : node.inputs) layers.push_back(layer_of.at(input));
    return layers;
  }

  int padded(int layer, const std::string& name, const std::array<int, 4>& border,
             const std::array<int, 2>& channels) {
    LayerParams params;
    params.set("paddings",
               list({0, 0, channels[0], channels[1], border[0], border[1], border[2], border[3]}));
    return add(name, "Padding", params, {layer});
  }

  int window(const Node& node, const std::string& name, LayerParams params,
             const std::string& type) {
    int from = layers(node).front();
    const auto& [top, bottom, left, right] = node.border;
    const bool symmetric = top == bottom && left == right;  // all that OpenCV computes rightly
    if (!symmetric) from = padded(from, name + "/padded", node.border, {0, 0});
    params.set("kernel_h", node.kernel_y);
    params.set("kernel_w", node.kernel_x);
    params.set("stride_h", node.stride_y);
    params.set("stride_w", node.stride_x);
    params.set("pad_h", symmetric ? top : 0);
    params.set("pad_w", symmetric ? left : 0);
    return add(name, type, params, {from});
  }

  int convolution(const Node& node, const std::string& name) {
    const auto outputs = static_cast<int>(node.bias.size());
    LayerParams params;
    params.set("num_output", outputs);
    params.set("bias_term", true);
    params.blobs = {
        blob(node.weights, {outputs, graph.shape(node.inputs[0])[3], node.kernel_y, node.kernel_x}),
        blob(node.bias, {outputs, 1})};
    return window(node, name, params, "Convolution");
  }

  int depthwise(const Node& node, const std::string& name) {
    const Depthwise convolution{node.kernel_y, node.kernel_x, node.stride_y, node.stride_x,
                                node.border,   node.relu6,    node.weights,  node.bias};
    return add(name, depthwise_layer_type(), layer_params(convolution), layers(node));
  }

  int permuted(int from, const std::string& name, const std::vector<int>& order) {
    LayerParams params;
    params.set("order", list(order));
    return add(name, "Permute", params, {from});
  }

  int reshaped(int from, const std::string& name, const std::vector<int>& sizes) {
    LayerParams params;
    params.set("dim", list(sizes));
    return add(name, "Reshape", params, {from});
  }

  int reshape(const Node& node, const std::string& name) {
    int from = layers(node).front();
    if (graph.shape(node.inputs[0]).size() == 4)
      from = permuted(from, name + "/rows", {0, 2, 3, 1});
    return reshaped(from, name, graph.shape(node.output));
  }

  int depth_to_space(const Node& node, const std::string& name) {
    const Shape &from = graph.shape(node.inputs[0]), &to = graph.shape(node.output);
    int layer = reshaped(layers(node).front(), name + "/blocks",
                         {1, node.block, node.block, to[3], from[1], from[2]});
    layer = permuted(layer, name + "/spread", {0, 3, 4, 1, 5, 2});
    return reshaped(layer, name, {1, to[3], to[1], to[2]});
  }

  int resize(const Node& node, const std::string& name) {
    const Shape& to = graph.shape(node.output);
    LayerParams params;
    params.set("height", to[1]);
    params.set("width", to[2]);
    params.set("interpolation", "opencv_linear");  // half-pixel centres
    return add(name, "Resize", params, layers(node));
  }

  int max_pool(const Node& node, const std::string& name) {
    LayerParams params;
    params.set("pool", "max");
    params.set("ceil_mode", false);
    return window(node, name, params, "Pooling");
  }

  int concatenation(const Node& node, const std::string& name) {
    const bool image = graph.shape(node.output).size() == 4;
    constexpr std::array kAxisOfImage{0, 2, 3, 1};
    LayerParams params;
    params.set("axis", image ? kAxisOfImage[static_cast<std::size_t>(node.axis)] : node.axis);
    return add(name, "Concat", params, layers(node));
  }

  int layer(const Node& node, const std::string& name) {
    switch (node.operation) {
      case Operation::convolution:
        return convolution(node, name);
      case Operation::depthwise_convolution:
        return depthwise(node, name);
      case Operation::addition:
        return add(name, "Eltwise", {}, layers(node));
      case Operation::padding:
        return padded(layers(node).front(), name, node.border, node.channel_border);
      case Operation::bilinear_resize:
        return resize(node, name);
      case Operation::max_pool:
        return max_pool(node, name);
      case Operation::reshape:
        return reshape(node, name);
      case Operation::sigmoid:
        return add(name, "Sigmoid", {}, layers(node));
      case Operation::depth_to_space:
        return depth_to_space(node, name);
      case Operation::concatenation:
        return concatenation(node, name);
    }
    return -1;
  }
};

}  // namespace

cv::dnn::Net net_of(const Graph& graph) {
  Builder builder{graph, {}};
  builder.layer_of[graph.input] = 0;
  for (const Node& node : graph.nodes) {
    const bool cut = node.relu6 && node.operation != Operation::depthwise_convolution;
    int layer = builder.layer(node, cut ? node.name + "/linear" : node.name);
    if (cut) layer = builder.add(node.name, "ReLU6", {}, {layer});
    builder.layer_of[node.output] = layer;
  }
  return builder.net;
}

void fold_padding(Graph& graph) {
  std::map<int, int> users;
  for (const Node& node : graph.nodes)
    for (const int input : node.inputs) ++users[input];
  for (const int output : graph.outputs) ++users[output];
  for (Node& padding : graph.nodes) {
    if (padding.operation != Operation::padding || padding.channel_border != std::array{0, 0} ||
        users[padding.output] != 1)
      continue;
    const auto user = std::ranges::find_if(graph.nodes, [&](const Node& n) {
      return std::ranges::count(n.inputs, padding.output) > 0;
    });
    const bool convolves = user->operation == Operation::convolution ||
                           user->operation == Operation::depthwise_convolution;
    if (!convolves || user->border != std::array{0, 0, 0, 0}) continue;
    user->border = padding.border;
    user->inputs = padding.inputs;
    padding.output = -1;  // gone
  }
  std::erase_if(graph.nodes, [](const Node& node) { return node.output < 0; });
}

}  // namespace stride::tflite
