#pragma once

#include <filesystem>
#include <opencv2/dnn/dnn.hpp>
#include <string>
#include <vector>

namespace stride::pose {

/// What a network computes of the input sin(0), sin(1), …: the first numbers of an output.
struct CheckedOutput {
  std::string name;
  std::vector<int> shape;
  std::vector<double> first;
};
/// Networks of one shape that are told apart by what they compute: heavy, full, lite.
using SelfCheck = std::vector<CheckedOutput>;

/// Reads a .tflite file into a network and runs it once. `checks`: any one must hold. Throws Error
/// naming the file and what is wrong, with the cure.
cv::dnn::Net load_network(const std::filesystem::path& file, int side,
                          const std::vector<SelfCheck>& checks);

}  // namespace stride::pose
