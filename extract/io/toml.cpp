#include "extract/io/toml.h"

#include <fmt/ranges.h>

#include <algorithm>
#define TOML_EXCEPTIONS 1
// It asserts what the text of a file can break, as "[ = 1", and refuses it in the next line.
#define TOML_ASSERT(condition) static_cast<void>(0)
#include <toml++/toml.h>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/outputs.h"

namespace stride {
namespace {

/// How many bytes of UTF-8 the letter at the start of a text has; 0: it is none.
std::size_t letter_bytes(std::string_view text) {
  const auto at = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned lead = at(0);
  const std::size_t count = lead < 0x80                   ? 1
                            : lead >= 0xc2 && lead < 0xe0 ? 2
                            : lead >= 0xe0 && lead < 0xf0 ? 3
                            : lead >= 0xf0 && lead < 0xf5 ? 4
                                                          : 0;
  for (std::size_t i = 1; i < count; ++i)
    if (at(i) < 0x80 || at(i) > 0xbf) return 0;
  // Overlong forms, surrogates, and what lies beyond Unicode.
  const bool none = (lead == 0xe0 && at(1) < 0xa0) || (lead == 0xed && at(1) > 0x9f) ||
                    (lead == 0xf0 && at(1) < 0x90) || (lead == 0xf4 && at(1) > 0x8f);
  return none ? 0 : count;
}

/// The line of the first letter outside ASCII that is in neither quotes nor a comment; 0: none.
int line_of_bare_letter(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // the byte order mark
  int line = 1;
  std::string_view end;  // of the text in quotes or of the comment; empty: in neither
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = text.substr(i);
    if (rest[0] == '\n') ++line;
    if (end.empty()) {
      if (static_cast<unsigned char>(rest[0]) >= 0x80) return line;
      for (const std::string_view begin : {"\"", "'", "\"\"\"", "'''"})
        if (rest.starts_with(begin)) end = begin;
      if (!end.empty()) i += end.size() - 1;
      if (rest[0] == '#') end = "\n";
    } else if (rest[0] == '\\' && end[0] == '"') {
      if (rest.substr(1).starts_with('\n')) ++line;
      ++i;
    } else if (rest.starts_with(end) || (rest[0] == '\n' && end.size() == 1)) {
      i += end.size() - 1;
      end = {};
    }
  }
  return 0;
}

/// A value as text: numbers as the shortest that reads back as the same.
std::string word_of(const toml::node& node, const std::string& source) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* whole = node.as_integer()) return fmt::format("{}", whole->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  throw Error(fmt::format("{}:{}: must be a number, a text, true, false or a list of these", source,
                          node.source().begin.line));
}

void add_settings(const toml::table& table, const std::vector<std::string>& section,
                  const std::string& source, std::vector<TomlSetting>& settings) {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (const auto* inner = node.as_table()) {
      std::vector<std::string> inside = section;
      inside.push_back(name);
      add_settings(*inner, inside, source, settings);
      continue;
    }
    TomlSetting setting{section, name, {}, static_cast<int>(key.source().begin.line)};
    if (const auto* list = node.as_array())
      for (const toml::node& element : *list) setting.words.push_back(word_of(element, source));
    else
      setting.words.push_back(word_of(node, source));
    settings.push_back(std::move(setting));
  }
}

}  // namespace

std::string TomlSetting::key() const {
  return section.empty() ? name : fmt::format("{}.{}", fmt::join(section, "."), name);
}

std::vector<TomlSetting> load_toml(const std::filesystem::path& file) {
  require_plain_text(file, "a file of settings (TOML)");
  return parse_toml(read_file(file), file.string());
}

std::vector<TomlSetting> parse_toml(const std::string& text, const std::string& source) {
  // toml++ 3.3 has no answer to "is it a space" for most of these.
  const int line = line_of_bare_letter(text);
  require(line == 0, "{}:{}: not TOML: a letter outside ASCII must be in quotes", source, line);
  std::vector<TomlSetting> settings;
  try {
    add_settings(toml::parse(text), {}, source, settings);
  } catch (const toml::parse_error& error) {
    std::string_view why = error.description();
    if (why.starts_with("Error while parsing"))  // the name of a rule of the grammar
      if (const auto colon = why.find(": "); colon != why.npos) why.remove_prefix(colon + 2);
    throw Error(fmt::format("{}:{}: not TOML: {}", source, error.source().begin.line, why));
  }
  std::ranges::stable_sort(settings, {}, &TomlSetting::line);
  return settings;
}

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  while (!text.empty()) {
    const std::size_t bytes = letter_bytes(text);
    const auto code = static_cast<unsigned char>(text[0]);
    if (bytes == 0)
      quoted += "\xef\xbf\xbd";  // U+FFFD
    else if (code < 0x20 || code == 0x7f)
      quoted += fmt::format("\\u{:04X}", code);
    else if (code == '"' || code == '\\')
      quoted += {'\\', text[0]};
    else
      quoted += text.substr(0, bytes);
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return quoted + '"';
}

}  // namespace stride
