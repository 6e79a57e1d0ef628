#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace stride {

/// A table of a flatbuffer that is to be written. Fields that were not set are left out.
struct FlatData {
  struct Field {
    int number;
    std::string scalar;            // its bytes, or
    std::vector<FlatData> tables;  // one table, or a list of them, or
    std::string elements;          // a list of scalars
    std::uint32_t count = 0;       // of them
    enum Kind { kScalar, kTable, kTables, kElements } kind = kScalar;
  };
  std::vector<Field> fields;

  template <typename T>
  FlatData& scalar(int number, T value) {
    fields.push_back({number,
                      std::string(reinterpret_cast<const char*>(&value), sizeof value),
                      {},
                      {},
                      0,
                      Field::kScalar});
    return *this;
  }
  template <typename T>
  FlatData& elements(int number, const std::vector<T>& values) {
    fields.push_back(
        {number,
         {},
         {},
         std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)),
         static_cast<std::uint32_t>(values.size()),
         Field::kElements});
    return *this;
  }
  FlatData& text(int number, const std::string& value);
  FlatData& table(int number, FlatData value);
  FlatData& tables(int number, std::vector<FlatData> values);
};

/// A flatbuffer with this root.
std::string flatbuffer(const FlatData& root, const std::string& identifier);

/// A small TensorFlow Lite network while it is put together.
class TfliteWriter {
 public:
  /// Tensors get the numbers 0, 1, … in the order in which they are added.
  int tensor(const std::string& name, const std::vector<int>& shape);
  int floats(const std::string& name, const std::vector<int>& shape,
             const std::vector<float>& values);
  int halves(const std::string& name, const std::vector<int>& shape,
             const std::vector<float>& values);
  int integers(const std::string& name, const std::vector<int>& values,
               const std::vector<int>& shape);
  FlatData& tensor_table(int number) { return tensors_[static_cast<std::size_t>(number)]; }

  void operation(int code, const std::vector<int>& inputs, int output, FlatData options = {});

  std::string file(const std::vector<int>& inputs, const std::vector<int>& outputs) const;

 private:
  int add(const std::string& name, const std::vector<int>& shape, std::int8_t type,
          const std::string& data);

  std::vector<FlatData> tensors_, buffers_, operators_, codes_;
};

}  // namespace stride
