#include "train/training/options.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "extract/io/file.h"
#include "tests/support/environment_variable.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

TEST(Options, ReadBackFromTheirToml) {
  TemporaryFolder folder;
  training::TrainOptions options;
  options.run.seed = 123456789012345;
  options.agent.gamma = 0.1 + 0.2;
  options.agent.actor_hidden = {400, 300};
  options.agent.critic_hidden = {7};
  options.replay.mirror = false;
  options.shaping.function = "pf2";
  write_file_atomically(folder / "a.toml", training::to_toml(options, "# heading\n"));
  training::TrainOptions read;
  training::read_toml(folder / "a.toml", read);
  EXPECT_EQ(training::to_toml(read, ""), training::to_toml(options, ""));
  EXPECT_EQ(read.agent.actor_hidden, options.agent.actor_hidden);
  EXPECT_EQ(read.agent.gamma, options.agent.gamma);
}

TEST(Options, UnknownKeysAreRefusedWithTheNearestKnownOne) {
  TemporaryFolder folder;
  training::TrainOptions options;
  write_file_atomically(folder / "a.toml", "[agent]\ngama = 0.9\n");
  EXPECT_ERROR(training::read_toml(folder / "a.toml", options),
               "a.toml: agent.gama: unknown key; did you mean "
               "agent.gamma?");
  EXPECT_ERROR(training::set_option("run.sed=3", options), "did you mean run.seed?");
}

TEST(Options, ValuesOfAnotherKindAreNamed) {
  training::TrainOptions options;
  EXPECT_ERROR(training::set_option("agent.gamma=high", options),
               "agent.gamma = high: must be a number");
  EXPECT_ERROR(training::set_option("run.seed=1.5", options),
               "run.seed = 1.5: must be a whole number");
  EXPECT_ERROR(training::set_option("agent.layer_norm=3", options), "must be true or false");
  EXPECT_ERROR(training::set_option("agent.gamma", options), "KEY=VALUE");
}

TEST(Options, ValuesOutOfRangeAreNamedWithTheRange) {
  const auto check = [](const char* assignment) {
    training::TrainOptions options;
    training::set_option(assignment, options);
    options.check();
  };
  EXPECT_ERROR(check("agent.gamma=1"), "agent.gamma = 1: must be in [0, ");
  EXPECT_ERROR(check("agent.gamma=nan"), "agent.gamma = nan: must be finite");
  EXPECT_ERROR(check("run.environments=0"), "run.environments = 0: must be in [1, ");
  EXPECT_ERROR(check("agent.actor_hidden=[64,0]"), "agent.actor_hidden = [64, 0]");
  EXPECT_ERROR(check("run.precision=half"), "must be one of float, double");
  EXPECT_ERROR(check("environment.reference_share=1.5"), "environment.reference_share = 1.5");
  check("run.decisions=2e6");
}

TEST(Options, PresetsAreValidAndAnUnknownOneIsNamed) {
  for (const char* preset : {"competition", "ddpg", "demo", "paper", "ppo", "shaping", "stride"}) {
    training::TrainOptions options;
    training::read_preset(preset, options);
    options.check();
  }
  training::TrainOptions options;
  EXPECT_ERROR(
      training::read_preset("fast", options),
      "preset 'fast': must be one of competition, ddpg, demo, paper, ppo, shaping, stride");
}

TEST(Options, APresetGoesOnFromItsBase) {
  const TemporaryFolder folder;
  const EnvironmentVariable data("STRIDE_DATA", folder.path().string());
  const auto write = [&](const char* name, const char* text) {
    write_file_atomically(folder / "train/presets" / name, text);
  };
  write("a.toml", "[agent]\ngamma = 0.8\ntau = 0.5\n");
  write("b.toml", "base = \"a\"\n[agent]\ngamma = 0.7\n");
  write("c.toml", "base = \"b\"\n[run]\nseed = 3\n");
  write("lost.toml", "base = \"nowhere\"\n");
  write("egg.toml", "base = \"hen\"\n");
  write("hen.toml", "base = \"egg\"\n");
  write("self.toml", "base = \"self\"\n");
  training::TrainOptions options;
  training::read_preset("c", options);
  EXPECT_EQ(options.agent.tau, 0.5);
  EXPECT_EQ(options.agent.gamma, 0.7);
  EXPECT_EQ(options.run.seed, 3);
  EXPECT_EQ(training::to_toml(options, "").find("base ="), std::string::npos);
  EXPECT_ERROR(training::read_preset("lost", options),
               "lost.toml: base = nowhere: must be one of a, b, c, egg, hen, lost, self");
  EXPECT_ERROR(training::read_preset("egg", options),
               "hen.toml: base = egg: must not lead back to this preset");
  EXPECT_ERROR(training::read_preset("self", options), "self.toml: base = self: must not");
  EXPECT_ERROR(training::read_toml(folder / "train/presets/b.toml", options),
               "b.toml: base: only a preset has one");
}

namespace fs = std::filesystem;

std::vector<fs::path> presets() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(STRIDE_SOURCE_DIR "/train/presets"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

TEST(Options, PresetsSayOnlyWhatDiffersFromTheirBases) {
  for (const fs::path& file : presets()) {
    std::vector<TomlSetting> settings = load_toml(file);
    training::TrainOptions before;
    const auto base = std::ranges::find(settings, "base", &TomlSetting::key);
    if (base != settings.end()) {
      training::read_preset(base->words.at(0), before);
      settings.erase(base);
    }
    for (const TomlSetting& setting : settings) {
      training::TrainOptions options = before;
      training::set_options({setting}, file.string(), options);
      EXPECT_NE(training::to_toml(options, ""), training::to_toml(before, ""))
          << file << ": " << setting.key() << " is as in the base or by default: leave it out";
    }
  }
}

/// The settings as to_toml() writes them: [section], then a line `name = value  # meaning` each.
struct Line {
  std::string key, value, meaning;
};

std::vector<Line> lines_of(const training::TrainOptions& options) {
  std::vector<Line> lines;
  std::istringstream text(training::to_toml(options, ""));
  std::string section;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with('[')) section = line.substr(1, line.size() - 2);
    const auto equals = line.find(" = "), hash = line.find("  # ");
    if (equals == std::string::npos) continue;
    lines.push_back({section + "." + line.substr(0, equals),
                     line.substr(equals + 3, hash == std::string::npos ? hash : hash - equals - 3),
                     hash == std::string::npos ? "" : line.substr(hash + 4)});
  }
  return lines;
}

/// train/presets/settings.md.
std::string settings_table() {
  std::string text =
      "Every setting of a run, its default, and what the presets make of it. Written by\n"
      "`STRIDE_WRITE_SETTINGS=1 train_learning_test "
      "--gtest_filter=Options.TableIsThatOfThePresets`.\n"
      "\n| setting | default |";
  std::vector<std::vector<Line>> columns{lines_of({})};
  for (const fs::path& file : presets()) {
    training::TrainOptions options;
    training::read_preset(file.stem().string(), options);
    const std::vector<Line> lines = lines_of(options);
    if (training::to_toml(options, "") == training::to_toml({}, "")) continue;
    columns.push_back(lines);
    text += fmt::format(" {} |", file.stem().string());
  }
  text += " |\n|---|";
  for (std::size_t i = 0; i < columns.size(); ++i) text += "---|";
  text += "---|\n";
  for (std::size_t i = 0; i < columns[0].size(); ++i) {
    const Line& line = columns[0][i];
    text += fmt::format("| `{}` |", line.key);
    for (const auto& column : columns)
      text += &column == &columns[0] || column[i].value != line.value
                  ? fmt::format(" {} |", column[i].value)
                  : " |";
    text += fmt::format(" {} |\n", line.meaning);
  }
  return text;
}

TEST(Options, TableIsThatOfThePresets) {
  const fs::path file = STRIDE_SOURCE_DIR "/train/presets/settings.md";
  if (std::getenv("STRIDE_WRITE_SETTINGS")) write_file_atomically(file, settings_table());
  EXPECT_EQ(read_file(file), settings_table());
}

}  // namespace
}  // namespace stride
