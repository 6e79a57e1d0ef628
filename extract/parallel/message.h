#pragma once

#include <cstring>
#include <string>
#include <type_traits>

#include "extract/io/error.h"

namespace stride::parallel {

/// A message that is written and read in the same order.
class Message {
 public:
  Message() = default;
  explicit Message(std::string bytes) : bytes_(std::move(bytes)) {}
  const std::string& bytes() const { return bytes_; }

  template <typename T>
  void put(const T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count == 0) return;  // an empty list has no address
    bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }
  template <typename T>
  void put(const T& value) {
    put(&value, 1);
  }
  void put(const std::string& text) {
    put(text.size());
    put(text.data(), text.size());
  }

  template <typename T>
  void get(T* values, std::size_t count) {
    require(at_ + count * sizeof(T) <= bytes_.size(),
            "a message of another rank is too short: all ranks must be the same program");
    if (count == 0) return;
    std::memcpy(static_cast<void*>(values), bytes_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
  }
  template <typename T>
  T get() {
    T value{};
    get(&value, 1);
    return value;
  }
  std::string get_text() {
    std::string text(get<std::size_t>(), '\0');
    get(text.data(), text.size());
    return text;
  }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace stride::parallel
