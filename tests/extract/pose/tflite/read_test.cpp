#include "extract/pose/tflite/read.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "extract/io/error.h"
#include "extract/pose/tflite/net.h"
#include "tests/support/tflite_writer.h"

namespace stride::tflite {
namespace {

using testing::HasSubstr;

/// Numbers in the order batch, y, x, channel.
struct Tensor {
  std::vector<int> shape;
  std::vector<float> values;

  int height() const { return shape[1]; }
  int width() const { return shape[2]; }
  int channels() const { return shape[3]; }
  /// 0 outside.
  float at(int y, int x, int c) const {
    if (y < 0 || x < 0 || y >= height() || x >= width()) return 0;
    return values[static_cast<std::size_t>((y * width() + x) * channels() + c)];
  }
};

Tensor random_tensor(std::vector<int> shape, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-2, 2);
  std::size_t count = 1;
  for (const int size : shape) count *= static_cast<std::size_t>(size);
  Tensor tensor{std::move(shape), std::vector<float>(count)};
  for (float& value : tensor.values) value = uniform(random);
  return tensor;
}

Tensor computed(std::vector<int> shape, const std::function<double(int, int, int)>& value) {
  Tensor tensor{std::move(shape), {}};
  for (int y = 0; y < tensor.height(); ++y)
    for (int x = 0; x < tensor.width(); ++x)
      for (int c = 0; c < tensor.channels(); ++c)
        tensor.values.push_back(static_cast<float>(value(y, x, c)));
  return tensor;
}

cv::Mat channels_first(const Tensor& tensor) {
  cv::Mat blob(std::vector<int>{1, tensor.channels(), tensor.height(), tensor.width()}, CV_32F);
  float* to = blob.ptr<float>();
  for (int c = 0; c < tensor.channels(); ++c)
    for (int y = 0; y < tensor.height(); ++y)
      for (int x = 0; x < tensor.width(); ++x) *to++ = tensor.at(y, x, c);
  return blob;
}

cv::Mat result_of(const std::string& file, const Tensor& input) {
  Graph graph = read_tflite(file);
  fold_padding(graph);
  cv::dnn::Net net = net_of(graph);
  net.setInput(channels_first(input));
  return net.forward(graph.names[static_cast<std::size_t>(graph.outputs.front())]).clone();
}

void expect_near(const cv::Mat& found, const Tensor& expected) {
  const cv::Mat wanted = channels_first(expected);
  ASSERT_EQ(found.total(), wanted.total());
  for (std::size_t i = 0; i < wanted.total(); ++i)
    ASSERT_NEAR(found.ptr<float>()[i], wanted.ptr<float>()[i], 1e-4) << "at " << i;
}

double relu6(double x) { return std::clamp(x, 0.0, 6.0); }

FlatData conv_options(int padding, int stride, int activation, bool depthwise) {
  FlatData options =
      FlatData().scalar(0, static_cast<std::int8_t>(padding)).scalar(1, stride).scalar(2, stride);
  if (depthwise) options.scalar(3, 1);
  return options.scalar(depthwise ? 4 : 3, static_cast<std::int8_t>(activation));
}

constexpr int kAdd = 0, kConcatenation = 2, kConv = 3, kDepthwise = 4, kDepthToSpace = 5,
              kDequantize = 6, kLogistic = 14, kMaxPool = 17, kReshape = 22, kResize = 23,
              kPad = 34, kDensify = 124;

TEST(TfliteReader, ConvolvesWithTheUnevenBorderOfStrideTwo) {
  const Tensor input = random_tensor({1, 8, 6, 3}, 1), weights = random_tensor({4, 3, 3, 3}, 2),
               bias = random_tensor({4}, 3);
  TfliteWriter writer;
  const int in = writer.tensor("in", input.shape),
            w = writer.floats("w", weights.shape, weights.values),
            b = writer.floats("b", bias.shape, bias.values),
            out = writer.tensor("out", {1, 4, 3, 4});
  writer.operation(kConv, {in, w, b}, out, conv_options(0, 2, 3, false));
  expect_near(
      result_of(writer.file({in}, {out}), input), computed({1, 4, 3, 4}, [&](int y, int x, int o) {
        double sum = bias.values[static_cast<std::size_t>(o)];
        for (int v = 0; v < 3; ++v)
          for (int u = 0; u < 3; ++u)
            for (int c = 0; c < 3; ++c)
              sum += weights.values[static_cast<std::size_t>(((o * 3 + v) * 3 + u) * 3 + c)] *
                     input.at(2 * y + v, 2 * x + u, c);
        return relu6(sum);
      }));
}

class DepthwiseOfStride : public testing::TestWithParam<std::tuple<int, int, int>> {};

TEST_P(DepthwiseOfStride, IsTheSumOverEachChannelsKernel) {
  const auto [kernel, stride, side] = GetParam();
  const Tensor input = random_tensor({1, side, side + 2, 5}, 4),
               weights = random_tensor({1, kernel, kernel, 5}, 5), bias = random_tensor({5}, 6);
  const int rows = (side + stride - 1) / stride, columns = (side + 2 + stride - 1) / stride;
  const auto before = [&, k = kernel, s = stride](int size, int outputs) {
    return std::max(0, (outputs - 1) * s + k - size) / 2;
  };
  TfliteWriter writer;
  const int in = writer.tensor("in", input.shape),
            w = writer.floats("w", weights.shape, weights.values),
            b = writer.floats("b", bias.shape, bias.values),
            out = writer.tensor("out", {1, rows, columns, 5});
  writer.operation(kDepthwise, {in, w, b}, out, conv_options(0, stride, 3, true));
  expect_near(
      result_of(writer.file({in}, {out}), input),
      computed({1, rows, columns, 5}, [&, k = kernel, s = stride, n = side](int y, int x, int c) {
        double sum = bias.values[static_cast<std::size_t>(c)];
        for (int v = 0; v < k; ++v)
          for (int u = 0; u < k; ++u)
            sum += weights.values[static_cast<std::size_t>((v * k + u) * 5 + c)] *
                   input.at(s * y + v - before(n, rows), s * x + u - before(n + 2, columns), c);
        return relu6(sum);
      }));
}

INSTANTIATE_TEST_SUITE_P(All, DepthwiseOfStride,
                         testing::Combine(testing::Values(3, 5), testing::Values(1, 2),
                                          testing::Values(4, 7, 16)));

TEST(TfliteReader, FoldsPaddingIntoTheConvolutionAfterIt) {
  const Tensor input = random_tensor({1, 5, 5, 1}, 7), weights = random_tensor({1, 3, 3, 1}, 8);
  TfliteWriter writer;
  const int in = writer.tensor("in", input.shape),
            w = writer.floats("w", weights.shape, weights.values),
            b = writer.floats("b", {1}, {0.5F}),
            border = writer.integers("border", {0, 0, 2, 1, 1, 1, 0, 0}, {4, 2}),
            padded = writer.tensor("padded", {1, 8, 7, 1}),
            out = writer.tensor("out", {1, 6, 5, 1});
  writer.operation(kPad, {in, border}, padded);
  writer.operation(kConv, {padded, w, b}, out, conv_options(1, 1, 0, false));
  const std::string file = writer.file({in}, {out});
  Graph graph = read_tflite(file);
  fold_padding(graph);
  EXPECT_EQ(graph.nodes.size(), 1U);
  expect_near(result_of(file, input), computed({1, 6, 5, 1}, [&](int y, int x, int) {
                double sum = 0.5;
                for (int v = 0; v < 3; ++v)
                  for (int u = 0; u < 3; ++u)
                    sum += weights.values[static_cast<std::size_t>(v * 3 + u)] *
                           input.at(y + v - 2, x + u - 1, 0);
                return sum;
              }));
}

TEST(TfliteReader, PadsChannelsThatAreAdded) {
  const Tensor input = random_tensor({1, 3, 4, 2}, 9);
  TfliteWriter writer;
  const int in = writer.tensor("in", input.shape),
            border = writer.integers("border", {0, 0, 0, 0, 0, 0, 1, 2}, {4, 2}),
            padded = writer.tensor("padded", {1, 3, 4, 5}),
            out = writer.tensor("out", {1, 3, 4, 5});
  writer.operation(kPad, {in, border}, padded);
  writer.operation(kAdd, {padded, padded}, out, FlatData().scalar(0, std::int8_t{3}));
  expect_near(result_of(writer.file({in}, {out}), input),
              computed({1, 3, 4, 5}, [&](int y, int x, int c) {
                return c < 1 || c > 2 ? 0 : relu6(2 * input.at(y, x, c - 1));
              }));
}

TEST(TfliteReader, ResizesWithHalfPixelCentres) {
  const Tensor input = random_tensor({1, 3, 4, 2}, 10);
  TfliteWriter writer;
  const int in = writer.tensor("in", input.shape), size = writer.integers("size", {6, 8}, {2}),
            out = writer.tensor("out", {1, 6, 8, 2});
  writer.operation(kResize, {in, size}, out, FlatData().scalar(3, true));
  expect_near(result_of(writer.file({in}, {out}), input),
              computed({1, 6, 8, 2}, [&](int y, int x, int c) {
                const double v = std::clamp((y + 0.5) / 2 - 0.5, 0.0, 2.0),
                             u = std::clamp((x + 0.5) / 2 - 0.5, 0.0, 3.0);
                const int v0 = static_cast<int>(v), u0 = static_cast<int>(u),
                          v1 = std::min(v0 + 1, 2), u1 = std::min(u0 + 1, 3);
                const double a = v - v0, b = u - u0;
                return (1 - a) * ((1 - b) * input.at(v0, u0, c) + b * input.at(v0, u1, c)) +
                       a * ((1 - b) * input.at(v1, u0, c) + b * input.at(v1, u1, c));
              }));
}

TEST(TfliteReader, TakesAnyByteButZeroForTrue) {
  const auto resized = [](std::uint8_t half_pixel_centres) {
    TfliteWriter writer;
    const int in = writer.tensor("in", {1, 3, 4, 2}), size = writer.integers("size", {6, 8}, {2}),
              out = writer.tensor("out", {1, 6, 8, 2});
    writer.operation(kResize, {in, size}, out, FlatData().scalar(3, half_pixel_centres));
    return read_tflite(writer.file({in}, {out})).nodes.size();
  };
  EXPECT_EQ(resized(248), 1U);
  EXPECT_THROW(resized(0), Error);
}

TEST(TfliteReader, PoolsAndSquashes) {
  const Tensor input = random_tensor({1, 4, 6, 2}, 11);
  TfliteWriter writer;
  const int in = writer.tensor("in", input.shape), pooled = writer.tensor("pooled", {1, 2, 3, 2}),
            out = writer.tensor("out", {1, 2, 3, 2});
  writer.operation(
      kMaxPool, {in}, pooled,
      FlatData().scalar(0, std::int8_t{0}).scalar(1, 2).scalar(2, 2).scalar(3, 2).scalar(4, 2));
  writer.operation(kLogistic, {pooled}, out);
  expect_near(result_of(writer.file({in}, {out}), input),
              computed({1, 2, 3, 2}, [&](int y, int x, int c) {
                float top = -10;
                for (int v = 0; v < 2; ++v)
                  for (int u = 0; u < 2; ++u)
                    top = std::max(top, input.at(2 * y + v, 2 * x + u, c));
                return 1 / (1 + std::exp(-static_cast<double>(top)));
              }));
}

TEST(TfliteReader, SpreadsDepthAndJoinsRowsInTensorFlowsOrder) {
  const Tensor input = random_tensor({1, 2, 3, 8}, 12);
  TfliteWriter writer;
  const int in = writer.tensor("in", input.shape), spread = writer.tensor("spread", {1, 4, 6, 2}),
            rows = writer.tensor("rows", {1, 24, 2}), out = writer.tensor("out", {1, 48, 2});
  writer.operation(kDepthToSpace, {in}, spread, FlatData().scalar(0, 2));
  writer.operation(kReshape, {spread}, rows);
  writer.operation(kConcatenation, {rows, rows}, out, FlatData().scalar(0, 1));
  const cv::Mat found = result_of(writer.file({in}, {out}), input);
  ASSERT_EQ(found.total(), 96U);
  for (int i = 0; i < 96; ++i) {
    const int place = i % 48 / 2, y = place / 6, x = place % 6, c = i % 2;
    EXPECT_EQ(found.ptr<float>()[i], input.at(y / 2, x / 2, (y % 2 * 2 + x % 2) * 2 + c));
  }
}

/// A 1 × 1 convolution of two channels with the given weights, as `prepare` adds them.
std::string with_weights(const std::function<int(TfliteWriter&)>& prepare) {
  TfliteWriter writer;
  const int in = writer.tensor("in", {1, 1, 1, 2}), out = writer.tensor("out", {1, 1, 1, 2});
  const int w = prepare(writer), b = writer.floats("b", {2}, {0, 0});
  writer.operation(kConv, {in, w, b}, out, conv_options(0, 1, 0, false));
  return writer.file({in}, {out});
}

TEST(TfliteReader, UnpacksHalfFloatsAndSparseWeights) {
  const std::string halves = with_weights([](TfliteWriter& writer) {
    const int packed = writer.halves("packed", {2, 1, 1, 2}, {0.5F, -2, 0, 3}),
              w = writer.tensor("w", {2, 1, 1, 2});
    writer.operation(kDequantize, {packed}, w);
    return w;
  });
  EXPECT_EQ(read_tflite(halves).nodes.front().weights, (std::vector<float>{0.5F, -2, 0, 3}));

  const std::string sparse = with_weights([](TfliteWriter& writer) {
    const int packed = writer.floats("packed", {2, 1, 1, 2}, {7, 9}),
              w = writer.tensor("w", {2, 1, 1, 2});
    const auto dense = [](int size) {
      return FlatData().scalar(0, std::int8_t{0}).scalar(1, size);
    };
    const auto list = [](const std::vector<std::uint8_t>& values) {
      return FlatData().elements(0, values);
    };
    const FlatData rows = FlatData()
                              .scalar(0, std::int8_t{1})
                              .scalar(2, std::uint8_t{3})
                              .table(3, list({0, 1, 2}))
                              .scalar(4, std::uint8_t{3})
                              .table(5, list({1, 0}));
    writer.tensor_table(packed).table(6, FlatData()
                                             .elements(0, std::vector<int>{0, 1, 2, 3})
                                             .tables(2, {dense(2), dense(1), dense(1), rows}));
    writer.operation(kDensify, {packed}, w);
    return w;
  });
  EXPECT_EQ(read_tflite(sparse).nodes.front().weights, (std::vector<float>{0, 7, 9, 0}));
}

std::string refusal(const std::string& file) {
  try {
    read_tflite(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(TfliteReader, NamesWhatItDoesNotKnow) {
  const auto one = [](int code, std::vector<int> out_shape, FlatData options) {
    TfliteWriter writer;
    const int in = writer.tensor("in", {1, 4, 4, 2}),
              out = writer.tensor("out", std::move(out_shape));
    writer.operation(code, {in}, out, std::move(options));
    return writer.file({in}, {out});
  };
  EXPECT_THAT(refusal(one(98, {1, 4, 4, 2}, {})), HasSubstr("operator 98"));
  EXPECT_THAT(refusal(one(kLogistic, {1, 4, 4, 3}, {})),
              HasSubstr("out is [1, 4, 4, 3]: must be [1, 4, 4, 2]"));
  EXPECT_THAT(refusal(one(kDepthToSpace, {1, 8, 8, 1}, FlatData().scalar(0, 3))),
              HasSubstr("blocks of 3"));
  EXPECT_THAT(refusal(one(kMaxPool, {1, 2, 2, 2},
                          FlatData().scalar(1, 2).scalar(2, 2).scalar(3, 2).scalar(4, 2).scalar(
                              5, std::int8_t{4}))),
              HasSubstr("fused activation 4"));
  EXPECT_THAT(refusal("PK\3\4 a zip file, not a network"), HasSubstr("TFL3"));
  EXPECT_THAT(refusal(""), HasSubstr("TFL3"));
}

TEST(TfliteReader, SurvivesAnyDamage) {
  const std::string whole = with_weights([](TfliteWriter& writer) {
    return writer.floats("w", {2, 1, 1, 2}, {1, 2, 3, 4});
  });
  ASSERT_EQ(refusal(whole), "");
  for (std::size_t length = 0; length < whole.size(); ++length) refusal(whole.substr(0, length));
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const int change : {1, 0x7F, 0x80, 0xFF}) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ change);
      refusal(damaged);
    }
}

}  // namespace
}  // namespace stride::tflite
