#include "extract/io/json/json_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "extract/io/error.h"

namespace stride {
namespace {

using nlohmann::json;

/// Reads a text and tells how far it has come, which the parser itself does not.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, const char** progress) : at_(at), progress_(progress) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    *progress_ = ++at_;
    return *this;
  }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  const char** progress_;
};

/// Walks through a valid JSON text until it meets the value at `pointer`.
class Search : public nlohmann::json_sax<json> {
 public:
  explicit Search(std::string pointer) : wanted_(std::move(pointer)) {}
  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return open(false); }
  bool start_array(std::size_t) override { return open(true); }
  bool key(string_t& name) override {
    path_.back().name = name;
    return true;
  }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override {
    return false;
  }

 private:
  struct Level {
    bool array;
    std::size_t element = 0;
    std::string name;
  };

  bool is_wanted() const {
    json::json_pointer pointer;
    for (const Level& level : path_)
      level.array ? pointer.push_back(std::to_string(level.element))
                  : pointer.push_back(level.name);
    return pointer.to_string() == wanted_;
  }
  void next() {
    if (!path_.empty()) ++path_.back().element;
  }
  bool value() {
    if (is_wanted()) return false;
    next();
    return true;
  }
  bool open(bool array) {
    if (is_wanted()) return false;
    path_.push_back({array, 0, {}});
    return true;
  }
  bool close() {
    path_.pop_back();
    next();
    return true;
  }

  std::string wanted_;
  std::vector<Level> path_;
};

/// JSON as Python writes it where a number is missing: NaN and Infinity, which JSON does not know,
/// become null.
std::string without_nan(std::string_view content) {
  std::string text;
  bool quoted = false;
  for (std::size_t i = 0; i < content.size(); ++i) {
    const char c = content[i];
    if (c == '"' && (i == 0 || content[i - 1] != '\\')) quoted = !quoted;
    const auto is = [&](std::string_view word) { return content.substr(i).starts_with(word); };
    const std::size_t length = quoted            ? 0
                               : is("NaN")       ? 3
                               : is("-Infinity") ? 9
                               : is("Infinity")  ? 8
                                                 : 0;
    if (length == 0) {
      text += c;
      continue;
    }
    text += "null";
    i += length - 1;
  }
  return text;
}

long line_at(std::string_view content, const char* position) {
  return 1 + std::count(content.data(), position, '\n');
}

long line_of(std::string_view content, const std::string& pointer) {
  const char* progress = content.data();
  Search search(pointer);
  json::sax_parse(CountingIterator(content.data(), &progress),
                  CountingIterator(content.data() + content.size(), &progress), &search);
  return line_at(content, progress);
}

/// Where the parser gave up for a number that no double holds.
long line_of_overflow(std::string_view content) {
  const char* progress = content.data();
  try {
    const json ignored = json::parse(CountingIterator(content.data(), &progress),
                                     CountingIterator(content.data() + content.size(), &progress));
  } catch (const json::exception&) {
  }
  return line_at(content, progress);
}

}  // namespace

JsonFile::~JsonFile() = default;
JsonFile::JsonFile(JsonFile&&) noexcept = default;

JsonFile::JsonFile(std::string_view content, std::string file)
    : content_(content), file_(std::move(file)), json_(std::make_unique<json>()) {
  try {
    *json_ = json::parse(content, nullptr, /*allow_exceptions=*/true);
  } catch (const json::parse_error& e) {
    if (const std::string text = without_nan(content); text != content) {
      const json again = json::parse(text, nullptr, /*allow_exceptions=*/false);
      if (!again.is_discarded()) {
        *json_ = again;
        return;
      }
    }
    const std::size_t byte = std::min(e.byte == 0 ? 0 : e.byte - 1, content.size());
    throw Error(fmt::format("{}:{}: not valid JSON at byte {}: expected a whole JSON document",
                            file_, line_at(content, content.data() + byte), byte));
  } catch (const json::exception& e) {
    throw Error(fmt::format("{}:{}: a number that is too large for JSON", file_,
                            line_of_overflow(content)));
  }
}

JsonValue JsonFile::root() const { return {*this, *json_, ""}; }

bool JsonValue::is_array() const { return json_->is_array(); }
bool JsonValue::is_object() const { return json_->is_object(); }
bool JsonValue::is_number() const { return json_->is_number(); }
bool JsonValue::is_text() const { return json_->is_string(); }
bool JsonValue::is_null() const { return json_->is_null(); }
bool JsonValue::has(std::string_view key) const {
  return json_->is_object() && json_->contains(key);
}

std::size_t JsonValue::size() const {
  if (!json_->is_array()) fail("an array");
  return json_->size();
}

JsonValue JsonValue::operator[](std::size_t element) const {
  if (!json_->is_array() || element >= json_->size())
    fail(fmt::format("an array of more than {} elements", element));
  return {*file_, (*json_)[element], fmt::format("{}/{}", pointer_, element)};
}

JsonValue JsonValue::operator[](std::string_view key) const {
  if (!has(key)) fail(fmt::format("an object with '{}'", key));
  json::json_pointer pointer(pointer_);
  pointer.push_back(std::string(key));
  return {*file_, json_->at(std::string(key)), pointer.to_string()};
}

std::vector<std::string> JsonValue::keys() const {
  if (!json_->is_object()) fail("an object");
  std::vector<std::string> keys;
  for (const auto& [key, value] : json_->items()) keys.push_back(key);
  return keys;
}

double JsonValue::number() const {
  if (!json_->is_number() || !std::isfinite(json_->get<double>())) fail("a number");
  return json_->get<double>();
}

int JsonValue::integer() const {
  const double value = json_->is_number() ? json_->get<double>() : 0.5;
  if (value != std::floor(value) || std::abs(value) > 1e9) fail("a whole number");
  return static_cast<int>(value);
}

std::string JsonValue::text() const {
  if (!json_->is_string()) fail("a text");
  return json_->get<std::string>();
}

std::vector<double> JsonValue::numbers() const {
  std::vector<double> numbers(size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const json& element = (*json_)[i];
    numbers[i] = element.is_null()     ? std::numeric_limits<double>::quiet_NaN()
                 : element.is_number() ? element.get<double>()
                                       : (*this)[i].number();
  }
  return numbers;
}

void JsonValue::fail(std::string_view expected) const {
  throw Error(fmt::format(
      "{}:{}: expected {} at {}, found {}", file_->file_, line_of(file_->content_, pointer_),
      expected, pointer_.empty() ? "the top" : pointer_,
      json_->is_structured() ? std::string(json_->type_name())
                             : json_->dump(-1, ' ', true, json::error_handler_t::replace)));
}

}  // namespace stride
