#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stride {

/// One line of a TOML file.
struct TomlSetting {
  std::vector<std::string> section;  // [clip.NAME]: clip, NAME
  std::string name;
  std::vector<std::string> words;  // the value; of a list its elements
  int line = 0;                    // in the file, from 1

  std::string key() const;  // section and name, joined by dots
};

/// The settings of a TOML file in its order. Throws Error where it cannot be read, or naming the
/// line where it is not TOML or has dates or tables in lists.
std::vector<TomlSetting> load_toml(const std::filesystem::path& file);
/// The same of a text, whose errors name `source`.
std::vector<TomlSetting> parse_toml(const std::string& text, const std::string& source);

/// A text as TOML writes it, in double quotes: reads back as the same whatever is in it.
std::string toml_text(std::string_view text);

}  // namespace stride
