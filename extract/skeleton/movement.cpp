#include "extract/skeleton/movement.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "extract/io/data_file.h"
#include "extract/io/error.h"
#include "extract/io/toml.h"

namespace stride {
namespace {

/// A value of the file, with what its errors say.
struct Setting {
  std::string what;
  const std::vector<std::string>& words;

  std::string word() const {
    require(words.size() == 1, "{}: must be one value", what);
    return words.front();
  }
  bool flag() const {
    require(word() == "true" || word() == "false", "{} = {}: must be true or false", what, word());
    return word() == "true";
  }
  double number() const {
    const std::string text = word();
    double value = 0;
    const auto end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    require(parsed.ec == std::errc() && parsed.ptr == end && value >= 0,
            "{} = {}: must be a number that is not negative", what, text);
    return value;
  }
};

void apply(const std::string& key, const Setting& setting, Movement& movement) {
  if (key == "meaning") {
    movement.meaning = setting.word();
  } else if (key == "repeats") {
    movement.repeats = setting.flag();
  } else if (key == "legs") {
    const auto legs = kLegs.find(setting.word());
    require(legs.has_value(), "{} = '{}': must be one of {}", setting.what, setting.word(),
            kLegs.list());
    movement.legs = *legs;
  } else if (key == "gait") {
    movement.gait = setting.word();
  } else if (key == "moments") {
    movement.moments = setting.words;
  } else if (key == "task") {
    movement.task = setting.word();
  } else if (key == "task_speed_m_s") {
    movement.task_speed_m_s = setting.number();
  } else if (key == "task_effort") {
    movement.task_effort = setting.number();
  } else if (key == "compare") {
    movement.compare = setting.word();
  } else {
    throw Error(fmt::format(
        "{}: is not known; use meaning, repeats, legs, gait, moments, task, task_speed_m_s, "
        "task_effort, compare",
        setting.what));
  }
}

std::vector<Movement> load(const std::filesystem::path& file) {
  std::vector<Movement> all;
  for (const TomlSetting& line : load_toml(file)) {
    require(line.section.size() == 1, "{}: {}: must be in the section of a movement, [run]",
            file.string(), line.key());
    if (all.empty() || all.back().name != line.section.front())
      all.emplace_back().name = line.section.front();
    apply(line.name, {fmt::format("{}: {}", file.string(), line.key()), line.words}, all.back());
  }
  for (const Movement& each : all)
    require(!each.task.empty(), "{}: {}.task: is missing", file.string(), each.name);
  return all;
}

}  // namespace

const std::vector<Movement>& movements() {
  static const std::vector<Movement> all = load(data_file("extract/skeleton/movements.toml"));
  return all;
}

const Movement& movement(std::string_view name, std::string_view what) {
  const std::string_view wanted = name.empty() ? kDefaultMovement : name;
  const auto found = std::ranges::find(movements(), wanted, &Movement::name);
  require(found != movements().end(), "{} = '{}': must be one of {}", what, wanted,
          movement_names());
  return *found;
}

std::string movement_names() {
  std::string names;
  for (const Movement& each : movements()) names += (names.empty() ? "" : ", ") + each.name;
  return names;
}

}  // namespace stride
