#include "extract/pose/load_network.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/pose/network.h"
#include "extract/pose/tflite/net.h"
#include "extract/pose/tflite/read.h"

namespace stride::pose {
namespace {

constexpr double kTolerance = 1e-3;  // of a number of the self-check, relative where it is above 1
constexpr const char* kCure = "run ./setup.sh --pose to fetch the network that Stride knows";

tflite::Graph read_graph(const std::filesystem::path& file, int side, const SelfCheck& check) {
  tflite::Graph graph = tflite::read_tflite(read_file(file));
  const tflite::Shape expected{1, side, side, 3};
  require(graph.shape(graph.input) == expected, "its input is {}: must be {}",
          graph.shape(graph.input), expected);
  for (const CheckedOutput& output : check) {
    const auto found = std::ranges::find_if(graph.outputs, [&](int tensor) {
      return graph.names[static_cast<std::size_t>(tensor)] == output.name;
    });
    require(found != graph.outputs.end(), "has no output {}", output.name);
    require(graph.shape(*found) == output.shape, "its output {} is {}: must be {}", output.name,
            graph.shape(*found), output.shape);
  }
  return graph;
}

double worst_error(const cv::Mat& output, const std::vector<double>& expected) {
  double worst = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    worst = std::max(worst, std::abs(output.ptr<float>()[i] - expected[i]) /
                                std::max(1.0, std::abs(expected[i])));
  return worst;
}

void check_itself(cv::dnn::Net& net, int side, const std::vector<SelfCheck>& checks) {
  std::vector<std::string> names;
  for (const CheckedOutput& output : checks.front()) names.push_back(output.name);
  std::vector<cv::Mat> outputs;
  net.setInput(self_check_input(side, side));
  net.forward(outputs, names);
  double least = std::numeric_limits<double>::infinity();
  for (const SelfCheck& check : checks) {
    double worst = 0;
    for (std::size_t i = 0; i < check.size(); ++i)
      worst = std::max(worst, worst_error(outputs[i], check[i].first));
    least = std::min(least, worst);
  }
  require(least <= kTolerance,
          "the self-check failed: its numbers differ by {:.2g}, at most {} is right", least,
          kTolerance);
}

}  // namespace

cv::dnn::Net load_network(const std::filesystem::path& file, int side,
                          const std::vector<SelfCheck>& checks) {
  try {
    tflite::Graph graph = read_graph(file, side, checks.front());
    tflite::fold_padding(graph);
    cv::dnn::Net net = tflite::net_of(graph);
    net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    check_itself(net, side, checks);
    return net;
  } catch (const cv::Exception& error) {
    throw Error(fmt::format("{}: OpenCV {} cannot run it ({}); {}", file.string(), CV_VERSION,
                            error.err, kCure));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}; {}", file.string(), error.what(), kCure));
  }
}

}  // namespace stride::pose
