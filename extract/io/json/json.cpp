#include "extract/io/json/json.h"

#include <fmt/format.h>

#include "extract/io/csv.h"

namespace stride {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::string json_text(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json parse_json(std::string_view content, const std::filesystem::path& file,
                std::string_view expected) {
  try {
    return Json::parse(content);
  } catch (const Json::parse_error& error) {
    throw Error(fmt::format("{}: not valid JSON at {}: expected {}", file.string(),
                            place_of_byte(content, error.byte > 0 ? error.byte - 1 : 0), expected));
  } catch (const Json::exception&) {
    throw Error(fmt::format("{}: not valid JSON: a number is too large", file.string()));
  }
}

JsonNode JsonNode::at(const std::string& key, std::string_view expected) const {
  const std::string full = path.empty() ? key : path + "." + key;
  const bool found = json.is_object() && json.contains(key);
  require(found || !expected.empty(), "{}: {} is missing", where, full);
  require(found, "{}: \"{}\" is missing: must be {}", where, full, expected);
  return {json.at(key), where, full};
}

JsonNode JsonNode::operator[](std::size_t i) const {
  return {json.at(i), where, fmt::format("{}[{}]", path, i)};
}

std::optional<JsonNode> JsonNode::find(const std::string& key) const {
  if (!json.contains(key) || json.at(key).is_null()) return std::nullopt;
  return at(key);
}

void JsonNode::fail(std::string_view expected) const {
  throw Error(fmt::format("{}: {} = {}: must be {}", where, path, json.dump(), expected));
}

}  // namespace stride
