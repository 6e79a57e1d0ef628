#pragma once

#include <map>
#include <string>
#include <vector>

#include "extract/pose/tflite/flatbuffer.h"
#include "extract/pose/tflite/graph.h"

namespace stride::tflite {

/// The tensors of a model: their shapes, and the numbers of those that are constant.
class TfliteTensors {
 public:
  /// `model`: the root table; `subgraph`: its only graph.
  TfliteTensors(const FlatTable& model, const FlatTable& subgraph);

  int size() const { return static_cast<int>(shapes_.size()); }
  const std::vector<Shape>& shapes() const { return shapes_; }
  const std::vector<std::string>& names() const { return names_; }
  const Shape& shape(int tensor) const;
  const std::string& name(int tensor) const;

  bool is_constant(int tensor) const;
  /// Numbers of a constant tensor of 16 or 32 bit floats, sparse or not.
  const std::vector<float>& floats(int tensor);
  std::vector<int> integers(int tensor) const;

  /// `to` is the constant `from` in another encoding.
  void rename_constant(int from, int to);

 private:
  void check(int tensor) const;
  std::string_view data(int tensor) const;
  std::vector<float> read(int tensor);

  std::vector<Shape> shapes_;
  std::vector<std::string> names_;
  FlatVector tensors_, buffers_;
  std::map<int, int> renamed_;
  std::map<int, std::vector<float>> floats_;
  std::size_t unpacked_ = 0;
};

}  // namespace stride::tflite
