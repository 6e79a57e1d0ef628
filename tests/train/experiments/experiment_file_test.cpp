#include "train/experiments/experiment_file.h"

#include <gtest/gtest.h>

#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"
#include "train/experiments/experiment.h"

namespace stride {
namespace {

constexpr const char* kHeading = "title = \"T\"\npreset = \"shaping\"\ndecisions = 4000\n";

experiments::ExperimentFile load(const TemporaryFolder& folder, const std::string& text,
                                 const std::vector<std::string>& settings = {}) {
  write_file_atomically(folder / "experiment.toml", text);
  return experiments::load_experiment(folder / "experiment.toml", settings);
}

TEST(ExperimentFile, GivesTheArmsInTheOrderOfTheFile) {
  const TemporaryFolder folder;
  const experiments::ExperimentFile experiment =
      load(folder, std::string(kHeading) + "seeds = 3\n[z]\npotential = \"\"\n[a]\n" +
                       "potential = \"../p/h.potential.json\"\nshaping.index = \"nearest\"\n" +
                       "agent.actor_hidden = [32, 16]\ncurves = \"../z\"\n");
  EXPECT_EQ(experiment.title, "T");
  EXPECT_EQ(experiment.decisions, 4000);
  EXPECT_EQ(experiment.seeds, 3);
  ASSERT_EQ(experiment.arms.size(), 2u);
  EXPECT_EQ(experiment.arms[0].name, "z");
  EXPECT_TRUE(experiment.arms[0].potential.empty());
  EXPECT_EQ(experiment.arms[1].potential, (folder / "../p/h.potential.json").lexically_normal());
  EXPECT_EQ(experiment.arms[1].curves, (folder / "../z").lexically_normal());
  EXPECT_EQ(experiment.arms[1].train.shaping.index, "nearest");
  EXPECT_EQ(experiment.arms[1].train.agent.actor_hidden, (std::vector<int>{32, 16}));
  EXPECT_EQ(experiment.arms[1].train.run.decisions, 4000);
  EXPECT_EQ(experiment.arms[0].train.shaping.index, "");
}

TEST(ExperimentFile, ALevelHasALabel) {
  const TemporaryFolder folder;
  const std::string arm = "[a]\npotential = \"\"\n";
  const experiments::ExperimentFile experiment =
      load(folder, kHeading + ("level = 11.2\nlevel_label = \"the weak agent\"\n" + arm));
  EXPECT_EQ(experiment.level.value, 11.2);
  EXPECT_EQ(experiment.level.label, "the weak agent");
  EXPECT_ERROR(load(folder, kHeading + ("level = 11.2\n" + arm)), "one needs the other");
  EXPECT_ERROR(load(folder, kHeading + ("level = \"high\"\nlevel_label = \"x\"\n" + arm)),
               "level = high: must be a number");
}

TEST(ExperimentFile, SeedsBeginWithTheFirst) {
  const TemporaryFolder folder;
  const std::string arm = "[a]\npotential = \"\"\n";
  EXPECT_EQ(load(folder, kHeading + arm).first_seed, 1);
  const experiments::ExperimentFile fresh =
      load(folder, std::string(kHeading) + "seeds = 2\nfirst_seed = 101\n" + arm);
  EXPECT_EQ(fresh.seeds, 2);
  EXPECT_EQ(fresh.first_seed, 101);
  EXPECT_ERROR(load(folder, std::string(kHeading) + "first_seed = 0\n" + arm),
               "first_seed = 0: must be a whole number in [1, 1000]");
}

TEST(ExperimentFile, SettingsOfTheCommandLineYieldToThoseOfAnArm) {
  const TemporaryFolder folder;
  const experiments::ExperimentFile experiment =
      load(folder, std::string(kHeading) + "[a]\nagent.gamma = 0.9\n[b]\npotential = \"\"\n",
           {"agent.gamma=0.95", "run.decisions=100"});
  EXPECT_EQ(experiment.arms[0].train.agent.gamma, 0.9);
  EXPECT_EQ(experiment.arms[1].train.agent.gamma, 0.95);
  EXPECT_EQ(experiment.decisions, 100);
}

TEST(ExperimentFile, CurvesOfAnotherExperimentAreNotThoseOfOtherSettings) {
  const TemporaryFolder folder;
  const std::string text = std::string(kHeading) + "[a]\ncurves = \"../z\"\n";
  EXPECT_FALSE(load(folder, text).arms[0].curves.empty());
  EXPECT_TRUE(load(folder, text, {"run.decisions=100"}).arms[0].curves.empty());
}

TEST(ExperimentFile, IsFoundInItsFolder) {
  const TemporaryFolder folder;
  load(folder, std::string(kHeading) + "[a]\npotential = \"\"\n");
  EXPECT_EQ(experiments::experiment_file((folder / ".").string()), folder / "experiment.toml");
}

TEST(ExperimentFile, ClaimsThatOneArmComesFartherThanAnother) {
  const TemporaryFolder folder;
  const std::string arms = "[a]\npotential = \"\"\n[b]\npotential = \"\"\n";
  const experiments::ExperimentFile usual = load(folder, kHeading + arms);
  EXPECT_EQ(usual.claim.better, "b");
  EXPECT_EQ(usual.claim.than, "a");
  EXPECT_EQ(usual.claim.at, 1);
  const experiments::ExperimentFile other = load(
      folder, std::string(kHeading) + "claim = \"c\"\nbetter = \"a\"\nthan = \"b\"\nat = 0.5\n" +
                  "clip = \"../h.calibrated.csv\"\n" + arms);
  EXPECT_EQ(other.claim.text, "c");
  EXPECT_EQ(other.claim.better, "a");
  EXPECT_EQ(other.claim.at, 0.5);
  EXPECT_EQ(other.clip, (folder / "../h.calibrated.csv").lexically_normal());
  EXPECT_ERROR(load(folder, std::string(kHeading) + "better = \"z\"\n" + arms), "which is no arm");
  EXPECT_ERROR(load(folder, std::string(kHeading) + "at = 0.4\n" + arms),
               "at = 0.4: must be one of");
}

TEST(ExperimentFile, ErrorsNameFileKeyAndCure) {
  const TemporaryFolder folder;
  const std::string arm = "[a]\npotential = \"\"\n";
  EXPECT_ERROR(load(folder, "title = \"T\"\n" + arm), "experiment.toml: preset is missing");
  EXPECT_ERROR(load(folder, kHeading), "has no arm");
  EXPECT_ERROR(load(folder, "colour = 1\n" + std::string(kHeading) + arm), "colour: unknown key");
  EXPECT_ERROR(load(folder, std::string(kHeading) + "seeds = \"many\"\n" + arm),
               "must be a whole number");
  EXPECT_ERROR(load(folder, std::string(kHeading) + arm + "agent.gama = 0.9\n"),
               "experiment.toml: [a]: agent.gama: unknown key; did you mean agent.gamma?");
  EXPECT_ERROR(load(folder, std::string(kHeading) + arm + "agent.gamma = 2\n"),
               "experiment.toml: [a]: agent.gamma = 2: must be in [0, 1)");
  EXPECT_ERROR(load(folder, std::string(kHeading) + "seeds = 0\n" + arm),
               "experiment.toml: seeds = 0: must be a whole number in [1, 1000]");
  EXPECT_ERROR(load(folder, std::string(kHeading) + "seeds = 2.5\n" + arm),
               "experiment.toml: seeds = 2.5: must be a whole number");
  EXPECT_ERROR(load(folder, std::string(kHeading) + "[a]\npotential = \"p\"\n" +
                                "shaping.scale = 0\nenvironment.reference_share = 0\n"),
               "[a]: potential: nothing of this arm uses it");
  EXPECT_ERROR(experiments::experiment_file("baseline-vs-nothing"),
               "must be one of baseline-vs-shaping");
}

/// The paper's nine figures, each with a claim about its arms; what an arm takes from another
/// experiment has that experiment's settings.
TEST(ExperimentFile, ThePapersFiguresAreAGroup) {
  const auto group = experiments::experiment_group("figures/all");
  EXPECT_EQ(group.size(), 9u);
  for (const std::filesystem::path& file : group) {
    SCOPED_TRACE(file.string());
    const experiments::ExperimentFile experiment = experiments::load_experiment(file);
    EXPECT_FALSE(experiment.claim.text.empty());
    EXPECT_EQ(experiment.seeds, 5);
    EXPECT_TRUE(std::filesystem::exists(experiment.clip));
    for (const experiments::ExperimentArm& arm : experiment.arms) {
      EXPECT_TRUE(arm.potential.empty() || std::filesystem::exists(arm.potential)) << arm.name;
      if (arm.curves.empty()) continue;
      const experiments::ExperimentFile other =
          experiments::load_experiment(arm.curves.parent_path() / "experiment.toml");
      const auto same = std::ranges::find(other.arms, arm.curves.filename().string(),
                                          &experiments::ExperimentArm::name);
      ASSERT_NE(same, other.arms.end()) << arm.name;
      EXPECT_EQ(training::to_toml(same->train, ""), training::to_toml(arm.train, "")) << arm.name;
      EXPECT_EQ(same->potential, arm.potential) << arm.name;
    }
    EXPECT_NE(experiments::verdict_row(file).find(experiment.claim.text), std::string::npos);
  }
  EXPECT_TRUE(experiments::experiment_group("baseline-vs-shaping").empty());
  EXPECT_ERROR(experiments::experiment_group("nothing/all"), "there is no such group");
}

TEST(ExperimentFile, TheOnesThatComeWithTheProgramCanBeRead) {
  const auto experiments =
      experiments::experiment_file("baseline-vs-shaping").parent_path().parent_path();
  for (const auto& entry : std::filesystem::directory_iterator(experiments)) {
    if (!std::filesystem::exists(entry.path() / "experiment.toml")) continue;
    for (const experiments::ExperimentArm& arm :
         experiments::load_experiment(entry.path() / "experiment.toml").arms)
      EXPECT_TRUE(arm.potential.empty() || std::filesystem::exists(arm.potential)) << arm.name;
  }
}

}  // namespace
}  // namespace stride
