#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace stride {

/// A JSON file of another program: errors name file, line, pointer and what was expected. It must
/// outlive its values.
class JsonFile {
 public:
  /// Throws Error naming file, line and column where `content` is not JSON.
  JsonFile(std::string_view content, std::string file);
  ~JsonFile();
  JsonFile(JsonFile&&) noexcept;

  class JsonValue root() const;

 private:
  friend class JsonValue;
  std::string_view content_;
  std::string file_;
  std::unique_ptr<nlohmann::json> json_;
};

/// A value in a JsonFile. Every function throws Error if the value is not of the requested kind.
class JsonValue {
 public:
  JsonValue(const JsonFile& file, const nlohmann::json& json, std::string pointer)
      : file_(&file), json_(&json), pointer_(std::move(pointer)) {}

  bool is_array() const;
  bool is_object() const;
  bool is_number() const;
  bool is_text() const;
  bool is_null() const;
  bool has(std::string_view key) const;  // false where this is no object

  std::size_t size() const;  // of an array
  JsonValue operator[](std::size_t element) const;
  JsonValue operator[](std::string_view key) const;
  std::vector<std::string> keys() const;  // of an object

  double number() const;  // finite
  int integer() const;
  std::string text() const;
  std::vector<double> numbers() const;  // of an array; null is NaN

  [[noreturn]] void fail(std::string_view expected) const;

 private:
  const JsonFile* file_;
  const nlohmann::json* json_;
  std::string pointer_;  // RFC 6901
};

}  // namespace stride
