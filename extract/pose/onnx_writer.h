#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace stride {

/// An array of an ONNX graph, row-major.
struct OnnxTensor {
  std::string name;
  std::vector<std::int64_t> shape;
  std::vector<float> values;
};

/// One operation: its type as in ONNX's list of operators (`Gemm`, `Conv`, …), the names of what it
/// reads and writes, its attributes.
struct OnnxNode {
  using Attribute = std::variant<std::int64_t, float, std::vector<std::int64_t>>;

  std::string op;
  std::vector<std::string> inputs, outputs;
  std::vector<std::pair<std::string, Attribute>> attributes = {};
};

/// A network: nodes in the order in which they are computed.
struct OnnxModel {
  struct Value {
    std::string name;
    std::vector<std::int64_t> shape;
  };

  std::string name;
  std::int64_t opset = 9;  // OpenCV 4.6 reads opsets up to 13
  std::vector<Value> inputs, outputs;
  std::vector<OnnxTensor> constants = {};
  std::vector<OnnxNode> nodes = {};
  std::map<std::string, std::string> metadata = {};
  std::string description = {};
};

/// The bytes of an .onnx file (onnx.proto3 of ONNX 1.4, IR version 4; all arrays are float32).
std::string to_onnx(const OnnxModel& model);

}  // namespace stride
