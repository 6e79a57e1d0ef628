#pragma once

#include <cstddef>
#include <cstring>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "extract/io/error.h"

namespace stride::tflite {

/// A value inside a flatbuffer, little-endian. Throws Error if it lies outside.
template <typename T>
T read_scalar(std::string_view bytes, std::size_t at) {
  require(at <= bytes.size() && sizeof(T) <= bytes.size() - at,
          "damaged: a value at byte {} lies past the end, {}", at, bytes.size());
  if constexpr (std::is_same_v<T, bool>) {
    return bytes[at] != 0;  // a damaged one is neither 0 nor 1
  } else {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof(T));
    return value;
  }
}

class FlatTable;

/// A vector of a flatbuffer. Whatever is asked of it is checked against the file's size.
class FlatVector {
 public:
  FlatVector() = default;
  /// `at`: the byte where its length stands.
  FlatVector(std::string_view bytes, std::size_t at, std::size_t element_bytes);

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  /// All elements as bytes.
  std::string_view bytes() const { return bytes_.substr(first_, size_ * element_bytes_); }

  template <typename T>
  T scalar(std::size_t i) const {
    check(i);
    return read_scalar<T>(bytes_, first_ + i * sizeof(T));
  }
  FlatTable table(std::size_t i) const;

  template <typename T>
  std::vector<T> scalars() const {
    std::vector<T> values(size_);
    for (std::size_t i = 0; i < size_; ++i) values[i] = scalar<T>(i);
    return values;
  }

 private:
  void check(std::size_t i) const;

  std::string_view bytes_;
  std::size_t first_ = 0, size_ = 0, element_bytes_ = 1;
};

/// A table of a flatbuffer: fields by their number in the schema, each may be missing. See
/// "Internals" in the FlatBuffers documentation for the format. Throws Error where the file is
/// damaged.
class FlatTable {
 public:
  FlatTable(std::string_view bytes, std::size_t at);

  template <typename T>
  T scalar(int field, T otherwise) const {
    const std::optional<std::size_t> at = place(field);
    return at ? read_scalar<T>(bytes_, *at) : otherwise;
  }
  std::optional<FlatTable> table(int field) const;
  /// Empty if the field is missing. Tables and strings in it are offsets of four bytes.
  FlatVector vector(int field, std::size_t element_bytes) const;
  std::string_view string(int field) const { return vector(field, 1).bytes(); }

 private:
  std::optional<std::size_t> place(int field) const;

  std::string_view bytes_;
  std::size_t at_ = 0, fields_ = 0, fields_bytes_ = 0;
};

/// The root table of a flatbuffer whose bytes 4 to 7 are `identifier`.
FlatTable root_table(std::string_view bytes, std::string_view identifier);

}  // namespace stride::tflite
