#include "extract/io/toml.h"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <sstream>

#include "extract/io/error.h"
#include "extract/io/file.h"

namespace stride {

std::string TomlSetting::key() const {
  return section.empty() ? name : fmt::format("{}.{}", fmt::join(section, "."), name);
}

std::vector<TomlSetting> load_toml(const std::filesystem::path& file) {
  return parse_toml(read_file(file), file.string());
}

std::vector<TomlSetting> parse_toml(const std::string& text, const std::string& source) {
  std::istringstream in(text);
  std::vector<CLI::ConfigItem> items;
  try {
    items = CLI::ConfigTOML().from_config(in);
  } catch (const CLI::Error& error) {  // CLI11's way to report; ours names the file
    throw Error(fmt::format("{}: not TOML: {}", source, error.what()));
  }
  std::vector<TomlSetting> settings;
  for (CLI::ConfigItem& item : items)
    if (item.name != "++" && item.name != "--")  // CLI11's marks around a section
      settings.push_back({std::move(item.parents), std::move(item.name), std::move(item.inputs)});
  return settings;
}

}  // namespace stride
