#include "extract/pose/onnx_writer.h"

#include <gtest/gtest.h>

#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

namespace stride {
namespace {

cv::Mat computed(const OnnxModel& model, const cv::Mat& input) {
  const std::string bytes = to_onnx(model);
  cv::dnn::Net net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
  net.setInput(input);
  return net.forward().clone();
}

TEST(OnnxWriter, OpenCvComputesTheConvolutionThatWasWritten) {
  const std::vector<float> kernel{1, 2, 0, -1, 3, 0, 0.5, 0, -2};
  const OnnxModel model{.name = "convolution",
                        .inputs = {{"image", {1, 1, 8, 9}}},
                        .outputs = {{"result", {1, 1, 8, 9}}},
                        .constants = {{"kernel", {1, 1, 3, 3}, kernel}, {"bias", {1}, {0.25F}}},
                        .nodes = {{.op = "Conv",
                                   .inputs = {"image", "kernel", "bias"},
                                   .outputs = {"sum"},
                                   .attributes = {{"kernel_shape", std::vector<std::int64_t>{3, 3}},
                                                  {"pads", std::vector<std::int64_t>{1, 1, 1, 1}}}},
                                  {.op = "LeakyRelu",
                                   .inputs = {"sum"},
                                   .outputs = {"result"},
                                   .attributes = {{"alpha", 0.5F}}}},
                        .metadata = {{"key", "value"}},
                        .description = std::string(300, 'x')};  // its length takes two bytes
  cv::Mat image(8, 9, CV_32F);
  cv::setRNGSeed(1);
  cv::randu(image, -1, 1);
  cv::Mat expected;
  cv::filter2D(image, expected, -1, cv::Mat(3, 3, CV_32F, const_cast<float*>(kernel.data())),
               {-1, -1}, 0.25, cv::BORDER_CONSTANT);
  expected = cv::max(expected, 0.5 * expected);
  const cv::Mat result = computed(model, cv::dnn::blobFromImage(image)).reshape(1, 8);
  EXPECT_LT(cv::norm(result, expected, cv::NORM_INF), 1e-5);
}

TEST(OnnxWriter, OpenCvComputesTheAffineMapThatWasWritten) {
  const OnnxModel model{
      .name = "map",
      .inputs = {{"x", {1, 2}}},
      .outputs = {{"y", {1, 3}}},
      .constants = {{"weight", {3, 2}, {1, 2, 3, 4, 5, -6}}, {"bias", {3}, {0.5F, 0, 100}}},
      .nodes = {{.op = "Gemm",
                 .inputs = {"x", "weight", "bias"},
                 .outputs = {"y"},
                 .attributes = {{"transB", std::int64_t{1}}}}}};
  const cv::Mat y = computed(model, cv::Mat(cv::Matx12f(10, 1)));
  EXPECT_LT(cv::norm(y, cv::Mat(cv::Matx13f(12.5F, 34, 144)), cv::NORM_INF), 1e-5);
}

}  // namespace
}  // namespace stride
