#include "train/experiments/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "extract/io/table.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"
#include "train/experiments/experiment_report.h"
#include "train/training/curve.h"

namespace stride {
namespace {

namespace fs = std::filesystem;

/// An evaluation every 1000 decisions, always of the same distance.
void write_even_run(const fs::path& run, double distance_m) {
  Table curve = training::new_curve();
  for (int i = 0; i <= 10; ++i) {
    std::vector<double> row(curve.columns.size(), 0.0);
    row[curve.column("decisions")] = 1000 * i;
    row[curve.column("evaluation_distance_m")] = distance_m;
    curve.rows.push_back(row);
  }
  save(curve, run / "curve.csv");
}

class Compare : public ::testing::Test {
 protected:
  void SetUp() override {
    write_even_run(folder / "a" / "1", 2);
    write_even_run(folder / "a" / "2", 8);
    write_even_run(folder / "a_control" / "1", 1);
    write_even_run(folder / "a_control" / "2", 4);
    write_even_run(folder / "b" / "1", 16);
    write_even_run(folder / "b_control" / "1", 1);
  }
  TemporaryFolder folder;
};

TEST_F(Compare, TakesTheGeometricMeanOverPairsOfAllExperiments) {
  // Ratios 2, 2 and 16: their geometric mean is 4.
  const experiments::PairedRatio expected = experiments::paired_ratio({2, 8, 16}, {1, 4, 1});
  EXPECT_NEAR(expected.ratio, 4, 1e-12);
  const std::string text =
      experiments::compare({.arms = {folder / "a", folder / "b"},
                            .controls = {folder / "a_control", folder / "b_control"},
                            .at = {5000},
                            .window = 2000});
  EXPECT_THAT(text, ::testing::HasSubstr("| 5000 | 2.0 ± 1.0 | 8.7 ± 4.1 | 3 | " +
                                         experiments::ratio_text(expected) + " |"));
}

TEST_F(Compare, OfArmsAloneIsTheirMeanDistance) {
  EXPECT_THAT(experiments::compare({.arms = {folder / "a"}, .controls = {}, .at = {10000, 3000}}),
              ::testing::EndsWith("| 10000 | 2 | 5.0 ± 3.0 |\n| 3000 | 2 | 5.0 ± 3.0 |\n"));
}

TEST_F(Compare, LeavesOutPairsWithoutARatio) {
  write_even_run(folder / "a" / "3", -1);
  write_even_run(folder / "a_control" / "3", 1);
  EXPECT_THAT(experiments::compare(
                  {.arms = {folder / "a"}, .controls = {folder / "a_control"}, .at = {5000}}),
              ::testing::HasSubstr("| 2 | 2.00 (2.00 … 2.00) |"));
}

TEST_F(Compare, AtEqualWallClockTheCheaperArmHasComeFarther) {
  // Evaluations at 0, 10, …, 100 s and at 0, 1, …, 10 s; both are 1 m farther at each.
  for (const auto& [arm, seconds] : {std::pair{"dear", 10.0}, std::pair{"cheap", 1.0}}) {
    Table curve = training::new_curve(), timing = training::new_timing();
    for (int i = 0; i <= 10; ++i) {
      std::vector<double> row(curve.columns.size(), 0.0), times(timing.columns.size(), 0.0);
      row[curve.column("decisions")] = times[timing.column("decisions")] = 1000 * i;
      row[curve.column("simulated_s")] = 30 * i;
      row[curve.column("evaluation_distance_m")] = i;
      times[timing.column("wall_s")] = seconds * i;
      curve.rows.push_back(row);
      timing.rows.push_back(times);
    }
    save(curve, folder / arm / "1" / "curve.csv");
    save(timing, folder / arm / "1" / "timing.csv");
  }
  experiments::CompareOptions options{.arms = {folder / "cheap"},
                                      .controls = {folder / "dear"},
                                      .against = "wall",
                                      .at = {10},
                                      .window = 0.5};
  EXPECT_THAT(experiments::compare(options),
              ::testing::AllOf(::testing::StartsWith("| wall clock, s | control, m |"),
                               ::testing::HasSubstr("| 10 | 1.0 | 10.0 | 1 |")));
  options.against = "simulated";
  options.at = {150};
  EXPECT_THAT(experiments::compare(options), ::testing::HasSubstr("| 150 | 5.0 | 5.0 | 1 |"));
  options.window.reset();
  EXPECT_ERROR(experiments::compare(options), "--window is needed, in seconds");
  options.against = "hours";
  EXPECT_ERROR(experiments::compare(options), "must be decisions, simulated or wall");
}

TEST_F(Compare, RefusesSeedsWithoutPartner) {
  EXPECT_ERROR(experiments::compare(
                   {.arms = {folder / "a"}, .controls = {folder / "b_control"}, .at = {5000}}),
               "must have the same seeds");
  EXPECT_ERROR(experiments::compare({.arms = {folder / "a"},
                                     .controls = {folder / "a_control", folder / "b_control"},
                                     .at = {5000}}),
               "1 arms and 2 controls");
  EXPECT_ERROR(experiments::compare({.arms = {folder / "none"}, .controls = {}, .at = {5000}}),
               "none: holds no run");
}

TEST(DistanceAt, AveragesTheWindowThatEndsThere) {
  Table curve = training::new_curve();
  for (int i = 0; i <= 10; ++i) {
    std::vector<double> row(curve.columns.size(), 0.0);
    row[curve.column("decisions")] = 1000 * i;
    row[curve.column("evaluation_distance_m")] = i;
    curve.rows.push_back(row);
  }
  EXPECT_EQ(experiments::distance_at(curve, 5000, 3000), 4);    // 3, 4, 5
  EXPECT_EQ(experiments::distance_at(curve, 5500, 100), 5);     // none in the window: the last
  EXPECT_EQ(experiments::distance_at(curve, 20000, 3000), 10);  // after the end: the last
}

}  // namespace
}  // namespace stride
