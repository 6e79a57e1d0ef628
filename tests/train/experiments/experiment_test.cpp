#include "train/experiments/experiment.h"

#include <gtest/gtest.h>

#include "extract/io/data_file.h"
#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

constexpr const char* kExperiment =
    "title = \"T\"\npreset = \"shaping\"\ndecisions = 4000\nseeds = 1\n"
    "[a]\npotential = \"p.potential.json\"\n";

/// An experiment of one arm and seed that is shaped by FOLDER/p.potential.json.
class Begun {
 public:
  Begun() { give_potential("human"); }

  void give_potential(const std::string& of) {
    write_file_atomically(folder_ / "p.potential.json",
                          read_file(data_file("train/results") / (of + ".potential.json")));
  }

  /// As far as the run folders. Returns whether it was finished.
  bool begin(const std::vector<std::string>& settings = {}, bool merge = false) {
    write_file_atomically(folder_ / "experiment.toml", kExperiment);
    experiments::ExperimentOptions options;
    options.experiment = experiments::load_experiment(folder_ / "experiment.toml", settings);
    options.runs = folder_ / "runs";
    options.report = folder_ / "report";
    options.merge = merge;
    const std::atomic<bool> stop = true;
    return experiments::run_experiment(options, stop, stderr);
  }

  std::filesystem::path run() const { return folder_ / "runs/a/1"; }

 private:
  TemporaryFolder folder_;
};

TEST(Experiment, ContinuesItsOwnRuns) {
  Begun begun;
  EXPECT_FALSE(begun.begin());
  EXPECT_TRUE(std::filesystem::exists(begun.run() / "config.toml"));
  EXPECT_FALSE(begun.begin());
}

TEST(Experiment, RefusesARunOfOtherSettings) {
  Begun begun;
  begun.begin();
  EXPECT_ERROR(begun.begin({"run.decisions=8000"}),
               "a/1: holds a run with run.decisions = 4000, not 8000: remove that folder");
  EXPECT_ERROR(begun.begin({"shaping.scale=0.5"}), "holds a run with shaping.scale");
}

TEST(Experiment, RefusesAFinishedRunOfAnotherPotential) {
  Begun begun;
  begun.begin();
  write_file_atomically(begun.run() / "finished", "");
  begun.give_potential("game");
  EXPECT_ERROR(begun.begin(), "potential.json: is another potential than the p.potential.json");
  EXPECT_ERROR(begun.begin({}, true), "is another potential");
}

TEST(Experiment, AMissingPotentialIsToldBeforeAnythingRuns) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "experiment.toml", kExperiment);
  EXPECT_ERROR(experiments::run_names(experiments::load_experiment(folder / "experiment.toml")),
               "p.potential.json");
}

}  // namespace
}  // namespace stride
