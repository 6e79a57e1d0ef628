#include "train/experiments/experiment_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "extract/io/data_file.h"
#include "extract/io/error.h"

namespace stride::experiments {
namespace fs = std::filesystem;
namespace {

/// The settings of each section in the file's order; those before the first section are under "".
using Sections = std::vector<std::pair<std::string, std::vector<TomlSetting>>>;

Sections sections_of(const fs::path& file) {
  Sections sections{{"", {}}};
  for (TomlSetting& setting : load_toml(file)) {
    std::string name;
    if (!setting.section.empty()) {
      name = setting.section.front();
      setting.section.erase(setting.section.begin());
    }
    auto section = std::ranges::find(sections, name, &Sections::value_type::first);
    if (section == sections.end()) section = sections.insert(section, {name, {}});
    section->second.push_back(std::move(setting));
  }
  return sections;
}

/// The settings of all arms. Of the four keys `seeds` may be missing.
void read_heading(const std::vector<TomlSetting>& settings, const fs::path& file,
                  ExperimentFile& experiment) {
  std::map<std::string, std::string> texts{{"seeds", std::to_string(experiment.seeds)}};
  for (const TomlSetting& setting : settings) {
    const std::string key = setting.key();
    require(key == "title" || key == "preset" || key == "decisions" || key == "seeds",
            "{}: {}: unknown key; before the arms there are title, preset, decisions and seeds",
            file.string(), key);
    require(setting.words.size() == 1, "{}: {}: one value is needed", file.string(), key);
    texts[key] = setting.words.front();
  }
  for (const char* key : {"title", "preset", "decisions"})
    require(texts.contains(key), "{}: {} is missing", file.string(), key);
  experiment.title = texts["title"];
  experiment.preset = texts["preset"];
  // Integers are read and checked like the settings of a run.
  training::TrainOptions numbers;
  training::set_options(
      {{{"run"}, "decisions", {texts["decisions"]}}, {{"run"}, "seed", {texts["seeds"]}}},
      file.string(), numbers);
  require(numbers.run.seed >= 1 && numbers.run.seed <= 1000, "{}: seeds = {}: must be in [1, 1000]",
          file.string(), texts["seeds"]);
  experiment.seeds = static_cast<int>(numbers.run.seed);
  experiment.decisions = numbers.run.decisions;
}

ExperimentArm arm_of(const std::string& name, std::vector<TomlSetting> settings,
                     const fs::path& file, const training::TrainOptions& common) {
  ExperimentArm arm{name, {}, common};
  std::erase_if(settings, [&](const TomlSetting& setting) {
    if (setting.key() != "potential") return false;
    require(setting.words.size() <= 1, "{}: {}.potential: one file is needed", file.string(), name);
    if (!setting.words.empty() && !setting.words.front().empty())
      arm.potential = (file.parent_path() / setting.words.front()).lexically_normal();
    return true;
  });
  training::set_options(settings, fmt::format("{}: [{}]", file.string(), name), arm.train);
  arm.train.check();
  return arm;
}

}  // namespace

fs::path experiment_file(const std::string& name) {
  if (name.ends_with(".toml")) return name;
  const fs::path folder = data_file("train/results");
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (fs::exists(entry.path() / "experiment.toml")) names.insert(entry.path().filename());
  require(names.contains(name), "experiment '{}': must be one of {}, or a .toml file", name,
          fmt::join(names, ", "));
  return folder / name / "experiment.toml";
}

ExperimentFile load_experiment(const fs::path& file, const std::vector<std::string>& settings) {
  Sections sections = sections_of(file);
  ExperimentFile experiment;
  read_heading(sections.front().second, file, experiment);
  require(sections.size() > 1, "{}: has no arm; add a section [NAME] for each", file.string());
  training::TrainOptions common;
  training::read_toml(training::preset_file(experiment.preset), common);
  common.run.decisions = experiment.decisions;
  for (const std::string& setting : settings) training::set_option(setting, common);
  experiment.decisions = common.run.decisions;
  for (auto section = std::next(sections.begin()); section != sections.end(); ++section)
    experiment.arms.push_back(arm_of(section->first, std::move(section->second), file, common));
  return experiment;
}

}  // namespace stride::experiments
