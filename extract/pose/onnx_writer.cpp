#include "extract/pose/onnx_writer.h"

#include <bit>
#include <string_view>

namespace stride {
namespace {

static_assert(std::endian::native == std::endian::little, "protobuf is little-endian");

/// A message of protobuf's wire format: every field is a varint of (number << 3 | kind), then its
/// value: kind 0 a varint, kind 2 its length and its bytes, kind 5 four bytes. Field numbers are
/// those of onnx.proto3.
class Message {
 public:
  void integer(int field, std::int64_t value) {
    varint(static_cast<std::uint64_t>(field) << 3);
    varint(static_cast<std::uint64_t>(value));
  }
  void bytes(int field, std::string_view value) {
    varint(static_cast<std::uint64_t>(field) << 3 | 2);
    varint(value.size());
    bytes_ += value;
  }
  void number(int field, float value) {
    varint(static_cast<std::uint64_t>(field) << 3 | 5);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void message(int field, const Message& value) { bytes(field, value.bytes_); }
  const std::string& text() const { return bytes_; }

 private:
  void varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) bytes_ += static_cast<char>(value | 0x80);
    bytes_ += static_cast<char>(value);
  }

  std::string bytes_;
};

constexpr int kFloat = 1;  // TensorProto.DataType

Message tensor(const OnnxTensor& value) {
  Message message;
  for (const std::int64_t n : value.shape) message.integer(1, n);  // dims
  message.integer(2, kFloat);                                      // data_type
  message.bytes(8, value.name);
  message.bytes(9, {reinterpret_cast<const char*>(value.values.data()),  // raw_data
                    value.values.size() * sizeof(float)});
  return message;
}

Message attribute(const std::string& name, const OnnxNode::Attribute& value) {
  Message message;
  message.bytes(1, name);
  if (const auto* f = std::get_if<float>(&value)) {
    message.number(2, *f);
    message.integer(20, 1);  // type: FLOAT
  } else if (const auto* i = std::get_if<std::int64_t>(&value)) {
    message.integer(3, *i);
    message.integer(20, 2);  // INT
  } else {
    for (const std::int64_t n : std::get<std::vector<std::int64_t>>(value)) message.integer(8, n);
    message.integer(20, 7);  // INTS
  }
  return message;
}

Message node(const OnnxNode& value) {
  Message message;
  for (const std::string& name : value.inputs) message.bytes(1, name);
  for (const std::string& name : value.outputs) message.bytes(2, name);
  if (!value.outputs.empty()) message.bytes(3, value.outputs.front());  // name
  message.bytes(4, value.op);
  for (const auto& [name, what] : value.attributes) message.message(5, attribute(name, what));
  return message;
}

Message value_info(const OnnxModel::Value& value) {
  Message shape, tensor_type, type, message;
  for (const std::int64_t n : value.shape) {
    Message dimension;
    dimension.integer(1, n);
    shape.message(1, dimension);
  }
  tensor_type.integer(1, kFloat);
  tensor_type.message(2, shape);
  type.message(1, tensor_type);
  message.bytes(1, value.name);
  message.message(2, type);
  return message;
}

}  // namespace

std::string to_onnx(const OnnxModel& model) {
  Message graph;
  for (const OnnxNode& value : model.nodes) graph.message(1, node(value));
  graph.bytes(2, model.name);
  for (const OnnxTensor& value : model.constants) graph.message(5, tensor(value));
  for (const OnnxModel::Value& value : model.inputs) graph.message(11, value_info(value));
  for (const OnnxModel::Value& value : model.outputs) graph.message(12, value_info(value));

  Message opset, file;
  opset.integer(2, model.opset);
  file.integer(1, 4);  // ir_version
  file.bytes(2, "stride");
  file.bytes(6, model.description);
  file.message(7, graph);
  file.message(8, opset);
  for (const auto& [key, value] : model.metadata) {
    Message property;
    property.bytes(1, key);
    property.bytes(2, value);
    file.message(14, property);
  }
  return file.text();
}

}  // namespace stride
