#pragma once

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "extract/io/error.h"

/// JSON of our own files. What other programs write is read by a JsonFile, which knows lines.
namespace stride {

/// A JSON document as our files hold it: indented, with a last newline. Bytes of names that are not
/// UTF-8 become U+FFFD.
std::string json_text(const nlohmann::ordered_json& json);
/// The document that `content` of `file` holds. Throws Error with file, line and column, and what
/// was `expected`: "a potential; make one with `stride convert`".
nlohmann::ordered_json parse_json(std::string_view content, const std::filesystem::path& file,
                                  std::string_view expected);
/// The same where a text that is no JSON is nothing to complain about: null.
template <typename Json = nlohmann::ordered_json>
Json json_or_null(std::string_view content) {
  Json json = Json::parse(content, nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded()) json = nullptr;
  return json;
}

/// A value in a document of ours and its place for errors: the file or a part of it, and the keys
/// from there. The document must outlive it.
struct JsonNode {
  const nlohmann::ordered_json& json;
  std::string where, path;

  /// The value of a key. Throws Error where it is missing, with what was `expected` if that is
  /// said.
  JsonNode at(const std::string& key, std::string_view expected = "") const;
  JsonNode operator[](const std::string& key) const { return at(key); }
  JsonNode operator[](std::size_t i) const;  // of a list
  /// Nothing where the key is missing or null.
  std::optional<JsonNode> find(const std::string& key) const;

  /// The value, or an error that names what was `expected`.
  template <typename T>
  T as(std::string_view expected) const;
  double number() const { return as<double>("a number"); }
  double number_or_unknown() const {  // null is written for what is not known
    return json.is_null() ? std::nan("") : number();
  }
  std::string text() const { return as<std::string>("text"); }

  template <typename T>
  T value(const std::string& key, std::string_view expected) const {
    return at(key, expected).template as<T>(expected);
  }
  template <typename T>
  T value_or(const std::string& key, T otherwise, std::string_view expected) const {
    const std::optional<JsonNode> found = find(key);
    return found ? found->template as<T>(expected) : otherwise;
  }

  [[noreturn]] void fail(std::string_view expected) const;
};

template <typename T>
T JsonNode::as(std::string_view expected) const {
  if constexpr (std::is_same_v<T, int>)
    if (!json.is_number() || !(std::abs(json.get<double>()) <= 1e9)) fail(expected);
  try {
    return json.get<T>();
  } catch (const nlohmann::ordered_json::exception&) {
    fail(expected);
  }
}

}  // namespace stride
