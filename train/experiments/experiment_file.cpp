#include "train/experiments/experiment_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "extract/io/csv.h"
#include "extract/io/data_file.h"
#include "extract/io/error.h"
#include "train/experiments/experiment_report.h"

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

/// The settings of all arms. Only title, preset and decisions must be there.
void read_heading(const std::vector<TomlSetting>& settings, const fs::path& file,
                  ExperimentFile& experiment) {
  constexpr std::array<std::string_view, 12> kKeys{
      "title",  "preset", "decisions", "seeds", "first_seed", "claim",
      "better", "than",   "at",        "clip",  "level",      "level_label"};
  std::map<std::string, std::string> texts;
  for (const TomlSetting& setting : settings) {
    const std::string key = setting.key();
    require(std::ranges::count(kKeys, key) > 0, "{}: {}: unknown key; before the arms there are {}",
            file.string(), key, fmt::join(kKeys, ", "));
    require(setting.words.size() == 1, "{}: {}: one value is needed", file.string(), key);
    texts[key] = setting.words.front();
  }
  for (const char* key : {"title", "preset", "decisions"})
    require(texts.contains(key), "{}: {} is missing", file.string(), key);
  experiment.title = texts["title"];
  experiment.preset = texts["preset"];
  const auto read_integer = [&](const char* key, std::int64_t most, auto& value) {
    if (!texts.contains(key)) return;
    const std::optional<double> number = cell_number(texts[key]);
    require(number && *number == std::floor(*number) && *number >= 1 &&
                *number <= static_cast<double>(most),
            "{}: {} = {}: must be a whole number in [1, {}]", file.string(), key, texts[key], most);
    value = static_cast<std::remove_reference_t<decltype(value)>>(*number);
  };
  read_integer("seeds", 1000, experiment.seeds);
  read_integer("first_seed", 1000, experiment.first_seed);
  read_integer("decisions", 1'000'000'000'000, experiment.decisions);
  if (!texts["clip"].empty())
    experiment.clip = (file.parent_path() / texts["clip"]).lexically_normal();
  experiment.claim = {.text = texts["claim"], .better = texts["better"], .than = texts["than"]};
  require(texts["level"].empty() == texts["level_label"].empty(),
          "{}: level and level_label: one needs the other", file.string());
  if (!texts["level"].empty()) {
    const std::optional<double> level = cell_number(texts["level"]);
    require(level.has_value() && std::isfinite(*level), "{}: level = {}: must be a number, metres",
            file.string(), texts["level"]);
    experiment.level = {*level, texts["level_label"]};
  }
  if (texts["at"].empty()) return;
  const std::string& at = texts["at"];
  const auto share = std::ranges::find_if(
      kBudgetShares, [&](double each) { return fmt::format("{}", each) == at; });
  require(share != kBudgetShares.end(), "{}: at = {}: must be one of {}", file.string(), at,
          fmt::join(kBudgetShares, ", "));
  experiment.claim.at = *share;
}

/// The arms of the claim are arms.
void complete_claim(const fs::path& file, ExperimentFile& experiment) {
  ExperimentClaim& claim = experiment.claim;
  if (claim.better.empty()) claim.better = experiment.arms.back().name;
  if (claim.than.empty()) claim.than = experiment.arms.front().name;
  for (const std::string& name : {claim.better, claim.than})
    require(std::ranges::count(experiment.arms, name, &ExperimentArm::name) > 0,
            "{}: the claim is about '{}', which is no arm", file.string(), name);
}

/// train/results/GROUP/NAME/experiment.toml, by name; the group may be empty.
std::map<std::string, fs::path> experiments_in(const fs::path& folder, const std::string& group) {
  std::map<std::string, fs::path> files;
  if (fs::is_directory(folder / group))
    for (const auto& entry : fs::directory_iterator(folder / group))
      if (fs::exists(entry.path() / "experiment.toml"))
        files[(fs::path(group) / entry.path().filename()).string()] =
            entry.path() / "experiment.toml";
  return files;
}

bool uses_potential(const training::TrainOptions& options) {
  return options.shaping.scale != 0 || options.shaping.stride_share > 0 ||
         options.environment.reference_share > 0 || options.environment.imitation.reward_per_s > 0;
}

ExperimentArm arm_of(const std::string& name, std::vector<TomlSetting> settings,
                     const fs::path& file, const training::TrainOptions& common) {
  ExperimentArm arm{name, {}, {}, common};
  std::erase_if(settings, [&](const TomlSetting& setting) {
    const std::string key = setting.key();
    if (key != "potential" && key != "curves") return false;
    require(setting.words.size() <= 1, "{}: {}.{}: one path is needed", file.string(), name, key);
    if (!setting.words.empty() && !setting.words.front().empty())
      (key == "curves" ? arm.curves : arm.potential) =
          (file.parent_path() / setting.words.front()).lexically_normal();
    return true;
  });
  const std::string source = fmt::format("{}: [{}]", file.string(), name);
  training::set_options(settings, source, arm.train);
  try {
    arm.train.check();
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", source, error.what()));
  }
  require(arm.potential.empty() || uses_potential(arm.train),
          "{}: potential: nothing of this arm uses it: shaping.scale = 0, and no episode starts on "
          "its run; set shaping.scale, shaping.stride_share or environment.reference_share",
          source);
  return arm;
}

}  // namespace

fs::path experiment_file(const std::string& name) {
  if (name.ends_with(".toml")) return name;
  fs::path in_folder = (fs::path(name) / "experiment.toml").lexically_normal();
  if (fs::exists(in_folder)) return in_folder;
  const fs::path folder = data_file("train/results");
  std::map<std::string, fs::path> files = experiments_in(folder, "");
  files.merge(experiments_in(folder, fs::path(name).parent_path().string()));
  std::vector<std::string> names;
  for (const auto& [each, file] : files) names.push_back(each);
  require(files.contains(name), "experiment '{}': must be one of {}, or a .toml file", name,
          fmt::join(names, ", "));
  return files.at(name);
}

std::vector<fs::path> experiment_group(const std::string& name) {
  std::vector<fs::path> group;
  if (!name.ends_with("/all")) return group;
  for (const auto& [each, file] :
       experiments_in(data_file("train/results"), fs::path(name).parent_path().string()))
    group.push_back(file);
  require(!group.empty(), "experiment '{}': there is no such group of experiments", name);
  return group;
}

ExperimentFile load_experiment(const fs::path& file, const std::vector<std::string>& settings) {
  Sections sections = sections_of(file);
  ExperimentFile experiment;
  read_heading(sections.front().second, file, experiment);
  require(sections.size() > 1, "{}: has no arm; add a section [NAME] for each", file.string());
  training::TrainOptions common;
  training::read_preset(experiment.preset, common);
  common.run.decisions = experiment.decisions;
  for (const std::string& setting : settings) training::set_option(setting, common);
  experiment.decisions = common.run.decisions;
  for (auto section = std::next(sections.begin()); section != sections.end(); ++section)
    experiment.arms.push_back(arm_of(section->first, std::move(section->second), file, common));
  if (!settings.empty())
    for (ExperimentArm& arm : experiment.arms) arm.curves.clear();
  complete_claim(file, experiment);
  return experiment;
}

}  // namespace stride::experiments
