// The TOML file of `stride convert`.
#include <fmt/ranges.h>

#include <CLI/TypeTools.hpp>
#include <cmath>

#include "extract/io/error.h"
#include "extract/io/toml.h"
#include "extract/skeleton/movement.h"
#include "shaping/pipeline/convert.h"

namespace stride::pipeline {
namespace {

struct Setting {
  std::string file, key, value;

  double number() const {
    double parsed = 0;
    require(CLI::detail::lexical_cast(value, parsed) && std::isfinite(parsed),
            "{}: {} = {}: must be a number", file, key, value);
    return parsed;
  }
  double number_in(double low, double high) const {
    const double parsed = number();
    require(parsed >= low && parsed <= high, "{}: {} = {}: must be in [{}, {}]", file, key, value,
            low, high);
    return parsed;
  }
  int whole_in(int low, int high) const {
    const double parsed = number_in(low, high);
    require(parsed == std::floor(parsed), "{}: {} = {}: must be a whole number", file, key, value);
    return static_cast<int>(parsed);
  }
  bool flag() const {
    require(value == "true" || value == "false", "{}: {} = {}: must be true or false", file, key,
            value);
    return value == "true";
  }
  template <typename Choice>
  Choice one_of(const Names<Choice>& names) const {
    const auto found = names.find(value);
    require(found.has_value(), "{}: {} = '{}': must be one of {}", file, key, value, names.list());
    return *found;
  }
  std::string one_of(std::initializer_list<const char*> choices) const {
    std::string names;
    for (const char* each : choices) {
      if (value == each) return value;
      names += fmt::format("{}{}", names.empty() ? "" : ", ", each);
    }
    throw Error(fmt::format("{}: {} = '{}': must be one of {}", file, key, value, names));
  }
};

void apply(const Setting& setting, ClipOptions& clip) {
  const std::string& key = setting.key;
  if (key == "height")
    clip.size = {.height_m = setting.number(), .leg_m = {}, .metres_per_pixel = {}};
  else if (key == "leg")
    clip.size = {.height_m = {}, .leg_m = setting.number(), .metres_per_pixel = {}};
  else if (key == "scale")
    clip.size = {.height_m = {}, .leg_m = {}, .metres_per_pixel = setting.number()};
  else if (key == "direction")
    clip.direction = kFacings.find(setting.one_of({"right", "left"}));
  else if (key == "movement")
    clip.movement = movement(setting.value, setting.file + ": movement").name;
  else if (key == "slow-motion")
    clip.slow_motion = setting.number_in(0.05, 100);
  else if (key == "force")
    clip.force = setting.flag();
  else if (key == "keyframes")
    clip.keyframes.count = setting.whole_in(2, 200);
  else if (key == "foot")
    clip.keyframes.foot = setting.one_of({"ankle", "toe"});
  else if (key == "symmetric")
    clip.keyframes.symmetric = setting.flag();
  else if (key == "function")
    clip.keyframes.function = setting.one_of(kInverseDistances);
  else if (key == "index")
    clip.keyframes.index = setting.one_of(kPotentialIndices);
  else if (key == "epsilon")
    clip.keyframes.epsilon_m = setting.number_in(1e-6, 10);
  else if (key == "weight")
    clip.keyframes.weight = setting.number_in(1e-9, 1e9);
  else
    throw Error(
        fmt::format("{}: key '{}' is not known; use height, leg, scale, direction, movement, "
                    "slow-motion, force, keyframes, foot, symmetric, function, index, "
                    "epsilon, weight",
                    setting.file, key));
}

}  // namespace

void load_convert_config(const std::filesystem::path& file, ConvertOptions& options) {
  const std::vector<TomlSetting> lines = load_toml(file);
  const auto each = [&](auto visit) {
    for (const TomlSetting& line : lines) {
      require(line.words.size() == 1, "{}: {}: one value is needed", file.string(), line.key());
      visit(line, Setting{file.string(), line.name, line.words.front()});
    }
  };
  each([&](const TomlSetting& line, const Setting& setting) {
    if (line.section.empty()) apply(setting, options.clip);
  });
  each([&](const TomlSetting& line, const Setting& setting) {
    if (line.section.empty()) return;
    require(line.section.size() == 2 && line.section[0] == "clip",
            "{}: section [{}] is not known; use [clip.NAME]", file.string(),
            fmt::join(line.section, "."));
    apply(setting, options.by_clip.try_emplace(line.section[1], options.clip).first->second);
  });
}

}  // namespace stride::pipeline
