#include "tests/support/tflite_writer.h"

#include <Eigen/Core>
#include <algorithm>
#include <utility>

namespace stride {
namespace {

template <typename T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// Where what was just appended lies, seen from the place that leads there.
void point_here(std::string& bytes, std::size_t from) {
  put(bytes, from, static_cast<std::uint32_t>(bytes.size() - from));
}

void append_table(std::string& bytes, const FlatData& data, std::size_t pointer) {
  int most = -1;
  for (const FlatData::Field& field : data.fields) most = std::max(most, field.number);
  const std::size_t vtable = bytes.size(), entries = static_cast<std::size_t>(most + 1);
  bytes.append(4 + 2 * entries, '\0');
  put(bytes, vtable, static_cast<std::uint16_t>(4 + 2 * entries));
  point_here(bytes, pointer);
  const std::size_t table = bytes.size();
  bytes.append(4, '\0');
  put(bytes, table, static_cast<std::int32_t>(table - vtable));
  std::vector<std::size_t> places;
  for (const FlatData::Field& field : data.fields) {
    places.push_back(bytes.size());
    put(bytes, vtable + 4 + 2 * static_cast<std::size_t>(field.number),
        static_cast<std::uint16_t>(bytes.size() - table));
    bytes += field.kind == FlatData::Field::kScalar ? field.scalar : std::string(4, '\0');
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const FlatData::Field& field = data.fields[i];
    if (field.kind == FlatData::Field::kTable) {
      append_table(bytes, field.tables.front(), places[i]);
    } else if (field.kind != FlatData::Field::kScalar) {
      point_here(bytes, places[i]);
      const bool tables = field.kind == FlatData::Field::kTables;
      const std::size_t length = bytes.size();
      bytes.append(4, '\0');
      put(bytes, length, tables ? static_cast<std::uint32_t>(field.tables.size()) : field.count);
      bytes += tables ? std::string(4 * field.tables.size(), '\0') : field.elements;
      for (std::size_t k = 0; k < field.tables.size(); ++k)
        append_table(bytes, field.tables[k], length + 4 + 4 * k);
    }
  }
}

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace

FlatData& FlatData::text(int number, const std::string& value) {
  return elements(number, std::vector<char>(value.begin(), value.end()));
}
FlatData& FlatData::table(int number, FlatData value) {
  fields.push_back({number, {}, {std::move(value)}, {}, 0, Field::kTable});
  return *this;
}
FlatData& FlatData::tables(int number, std::vector<FlatData> values) {
  fields.push_back({number, {}, std::move(values), {}, 0, Field::kTables});
  return *this;
}

std::string flatbuffer(const FlatData& root, const std::string& identifier) {
  std::string bytes = std::string(4, '\0') + identifier;
  append_table(bytes, root, 0);
  return bytes;
}

int TfliteWriter::add(const std::string& name, const std::vector<int>& shape, std::int8_t type,
                      const std::string& data) {
  buffers_.push_back(FlatData().elements(0, std::vector<char>(data.begin(), data.end())));
  tensors_.push_back(FlatData()
                         .elements(0, shape)
                         .scalar(1, type)
                         .scalar(2, static_cast<std::uint32_t>(buffers_.size() - 1))
                         .text(3, name));
  return static_cast<int>(tensors_.size()) - 1;
}

int TfliteWriter::tensor(const std::string& name, const std::vector<int>& shape) {
  return add(name, shape, 0, "");
}
int TfliteWriter::floats(const std::string& name, const std::vector<int>& shape,
                         const std::vector<float>& values) {
  return add(name, shape, 0, bytes_of(values));
}
int TfliteWriter::halves(const std::string& name, const std::vector<int>& shape,
                         const std::vector<float>& values) {
  std::vector<Eigen::half> halves(values.begin(), values.end());
  return add(name, shape, 1, bytes_of(halves));
}
int TfliteWriter::integers(const std::string& name, const std::vector<int>& values,
                           const std::vector<int>& shape) {
  return add(name, shape, 2, bytes_of(values));
}

void TfliteWriter::operation(int code, const std::vector<int>& inputs, int output,
                             FlatData options) {
  codes_.push_back(FlatData().scalar(0, static_cast<std::int8_t>(code)).scalar(3, code));
  operators_.push_back(FlatData()
                           .scalar(0, static_cast<std::uint32_t>(codes_.size() - 1))
                           .elements(1, inputs)
                           .elements(2, std::vector<int>{output})
                           .table(4, std::move(options)));
}

std::string TfliteWriter::file(const std::vector<int>& inputs,
                               const std::vector<int>& outputs) const {
  const FlatData graph =
      FlatData().tables(0, tensors_).elements(1, inputs).elements(2, outputs).tables(3, operators_);
  return flatbuffer(
      FlatData().scalar(0, 3).tables(1, codes_).tables(2, {graph}).tables(4, buffers_), "TFL3");
}

}  // namespace stride
