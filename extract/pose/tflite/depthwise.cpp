#include "extract/pose/tflite/depthwise.h"

#include <Eigen/Core>
#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <opencv2/dnn/layer.details.hpp>

namespace stride::tflite {
namespace {

constexpr int kBlock = 32;  // results that are kept in registers
using Block = Eigen::Array<float, kBlock, 1>;

/// Scratch memory of one channel: the image with its border, rows one after the other, and the
/// results at every place of it, of which each row's first are wanted.
struct Plane {
  int height, width;  // with the border
  std::vector<float> padded, results;

  Plane(const Depthwise& c, int rows, int columns)
      : height(rows + c.border[0] + c.border[1]),
        width(columns + c.border[2] + c.border[3]),
        // A block may begin at any place, and is read under any cell of the kernel.
        padded(static_cast<std::size_t>(height * width + kBlock + c.kernel_y * width)),
        results(static_cast<std::size_t>(height * width + kBlock)) {}
};

void convolve(const Depthwise& c, const float* weights, float bias, Plane& plane, int length) {
  for (int first = 0; first < length; first += kBlock) {
    Block sum = Block::Constant(bias);
    const float *weight = weights, *row = plane.padded.data() + first;
    for (int y = 0; y < c.kernel_y; ++y, row += plane.width)
      for (int x = 0; x < c.kernel_x; ++x) sum += *weight++ * Eigen::Map<const Block>(row + x);
    if (c.relu6) sum = sum.max(0.F).min(6.F);
    Eigen::Map<Block>(plane.results.data() + first) = sum;
  }
}

}  // namespace

void apply(const Depthwise& c, const cv::Mat& image, cv::Mat& result) {
  const int rows = image.size[2], columns = image.size[3], channels = image.size[1];
  const int rows_out = result.size[2], columns_out = result.size[3];
  cv::parallel_for_(cv::Range(0, channels), [&](const cv::Range& range) {
    Plane plane(c, rows, columns);
    for (int channel = range.start; channel < range.end; ++channel) {
      const auto* from = image.ptr<float>(0, channel);
      for (int y = 0; y < rows; ++y)
        std::copy_n(from + y * columns, columns,
                    plane.padded.data() + (y + c.border[0]) * plane.width + c.border[2]);
      convolve(c, c.weights.data() + channel * c.kernel_y * c.kernel_x,
               c.bias[static_cast<std::size_t>(channel)], plane,
               ((rows_out - 1) * c.stride_y + 1) * plane.width);
      auto* to = result.ptr<float>(0, channel);
      for (int y = 0; y < rows_out; ++y) {
        const float* row = plane.results.data() + y * c.stride_y * plane.width;
        for (int x = 0; x < columns_out; ++x) *to++ = row[x * c.stride_x];
      }
    }
  });
}

namespace {

class DepthwiseLayer : public cv::dnn::Layer {
 public:
  explicit DepthwiseLayer(const cv::dnn::LayerParams& params) : cv::dnn::Layer(params) {
    const auto get = [&](const char* key) { return params.get<int>(key); };
    convolution_.kernel_y = get("kernel_y");
    convolution_.kernel_x = get("kernel_x");
    convolution_.stride_y = get("stride_y");
    convolution_.stride_x = get("stride_x");
    convolution_.border = {get("top"), get("bottom"), get("left"), get("right")};
    convolution_.relu6 = get("relu6") != 0;
    const cv::Mat &weights = params.blobs[0], &bias = params.blobs[1];
    convolution_.weights.assign(weights.ptr<float>(), weights.ptr<float>() + weights.total());
    convolution_.bias.assign(bias.ptr<float>(), bias.ptr<float>() + bias.total());
    blobs.clear();
  }

  static cv::Ptr<cv::dnn::Layer> create(cv::dnn::LayerParams& params) {
    return cv::makePtr<DepthwiseLayer>(params);
  }

  bool getMemoryShapes(const std::vector<std::vector<int>>& inputs, int /*outputs*/,
                       std::vector<std::vector<int>>& outputs,
                       std::vector<std::vector<int>>& /*internals*/) const override {
    const Depthwise& c = convolution_;
    const std::vector<int>& in = inputs[0];
    outputs = {{in[0], in[1], (in[2] + c.border[0] + c.border[1] - c.kernel_y) / c.stride_y + 1,
                (in[3] + c.border[2] + c.border[3] - c.kernel_x) / c.stride_x + 1}};
    return false;
  }

  void forward(cv::InputArrayOfArrays inputs, cv::OutputArrayOfArrays outputs,
               cv::OutputArrayOfArrays /*internals*/) override {
    std::vector<cv::Mat> in, out;
    inputs.getMatVector(in);
    outputs.getMatVector(out);
    apply(convolution_, in[0], out[0]);
  }

 private:
  Depthwise convolution_;
};

}  // namespace

const char* depthwise_layer_type() {
  static constexpr const char* kType = "StrideDepthwise";
  static const bool registered = [] {
    cv::dnn::LayerFactory::registerLayer(kType, DepthwiseLayer::create);
    return true;
  }();
  (void)registered;
  return kType;
}

cv::dnn::LayerParams layer_params(const Depthwise& c) {
  cv::dnn::LayerParams params;
  params.set("kernel_y", c.kernel_y);
  params.set("kernel_x", c.kernel_x);
  params.set("stride_y", c.stride_y);
  params.set("stride_x", c.stride_x);
  params.set("top", c.border[0]);
  params.set("bottom", c.border[1]);
  params.set("left", c.border[2]);
  params.set("right", c.border[3]);
  params.set("relu6", c.relu6 ? 1 : 0);
  params.blobs = {cv::Mat(c.weights, true), cv::Mat(c.bias, true)};
  return params;
}

}  // namespace stride::tflite
