#include "train/experiments/plot.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "extract/io/file.h"
#include "extract/io/table.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"
#include "train/experiments/experiment_report.h"
#include "train/training/curve.h"

namespace stride {
namespace {

namespace fs = std::filesystem;

/// A run whose distance grows by `slope` metres with each evaluation, after so many decisions.
void write_run(const fs::path& run, double slope, double decisions = 1000) {
  Table curve = training::new_curve(), timing = training::new_timing();
  for (int i = 0; i <= 10; ++i) {
    std::vector<double> row(curve.columns.size(), 0.0);
    row[0] = decisions * i;
    row[1] = 30 * i;
    row[6] = slope * i;
    curve.rows.push_back(row);
    timing.rows.push_back({decisions * i, 60.0 * i, 1, 1});
  }
  save(curve, run / "curve.csv");
  save(timing, run / "timing.csv");
}

TEST(Plot, RunsNamedByANumberAreSeedsOfTheArmAbove) {
  const std::vector<experiments::Arm> arms = experiments::arms_of(
      {"x/baseline/1", "x/shaped/1", "x/baseline/2/", "runs/alone", "runs/other"});
  ASSERT_EQ(arms.size(), 4u);
  EXPECT_EQ(arms[0].label, "baseline");
  EXPECT_EQ(arms[0].runs.size(), 2u);
  EXPECT_EQ(arms[2].label, "alone");
}

TEST(Plot, DrawsMeanAndStandardErrorAndLeavesScriptAndFigures) {
  TemporaryFolder folder;
  write_run(folder / "arm" / "1", 1);
  write_run(folder / "arm" / "2", 3);
  experiments::plot(experiments::arms_of({folder / "arm" / "1", folder / "arm" / "2"}),
                    {.out = folder / "p" / "figure"});
  const Table figures = load_csv([&] {
    write_file_atomically(folder / "with_head.csv",
                          "x,mean,se\n" + read_file(folder / "p" / "figure.csv"));
    return folder / "with_head.csv";
  }());
  EXPECT_EQ(figures.rows.back()[0], 10000);
  EXPECT_NEAR(figures.rows.back()[1], 20, 1e-12);
  EXPECT_NEAR(figures.rows.back()[2], 10, 1e-12);  // |30 − 10| / 2
  EXPECT_NEAR(figures.rows[100][1], 2 * figures.rows[100][0] / 1000, 1e-9);
  EXPECT_THAT(read_file(folder / "p" / "figure.svg"), ::testing::HasSubstr("arm (2 seeds)"));
  EXPECT_EQ(read_file(folder / "p" / "figure.png").substr(1, 3), "PNG");
  EXPECT_TRUE(fs::exists(folder / "p" / "figure.gnuplot"));
}

TEST(Plot, ALevelIsDrawnWithItsLabel) {
  TemporaryFolder folder;
  write_run(folder / "arm" / "1", 1);
  experiments::plot(experiments::arms_of({folder / "arm" / "1"}),
                    {.level = {4.5, "the weak agent"}, .out = folder / "figure"});
  EXPECT_THAT(read_file(folder / "figure.gnuplot"), ::testing::HasSubstr("4.5 with lines"));
  EXPECT_THAT(read_file(folder / "figure.svg"), ::testing::HasSubstr("the weak agent"));
}

TEST(Plot, BeyondAMillionTheAxisCountsMillions) {
  TemporaryFolder folder;
  write_run(folder / "run", 1, 150'000);
  experiments::plot(experiments::arms_of({folder / "run"}), {.out = folder / "figure"});
  const std::string picture = read_file(folder / "figure.svg");
  for (const char* label : {"decisions (millions)", ">1.2<", ">1.4<"})
    EXPECT_THAT(picture, ::testing::HasSubstr(label));
}

TEST(Plot, WatchedItIsDrawnAnewWhenACurveGrows) {
  TemporaryFolder folder;
  std::atomic<bool> stop = false;
  std::thread watcher([&] {
    experiments::watch(experiments::arms_of({folder / "run"}), {.out = folder / "figure"}, stop,
                       nullptr);  // no curve yet
  });
  const auto drawn_within_seconds = [&](const std::string& what) {
    for (int i = 0; i < 500; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(20)))
      if (fs::exists(folder / "figure.png") &&
          read_file(folder / "figure.csv").find(what) != std::string::npos)
        return true;
    return false;
  };
  write_run(folder / "run", 1);
  EXPECT_TRUE(drawn_within_seconds("\n10000,10,0\n"));
  write_run(folder / "run", 2);
  EXPECT_TRUE(drawn_within_seconds("\n10000,20,0\n"));
  stop = true;
  watcher.join();
}

TEST(Plot, ErrorsNameTheRunAndTheColumn) {
  TemporaryFolder folder;
  write_run(folder / "a", 1);
  EXPECT_ERROR(experiments::plot(experiments::arms_of({folder / "b"}), {.out = folder / "p"}),
               "curve.csv: no such file");
  EXPECT_ERROR(experiments::plot(experiments::arms_of({folder / "a"}),
                                 {.column = "speed", .out = folder / "p"}),
               "column 'speed' is missing");
  EXPECT_ERROR(experiments::plot(experiments::arms_of({folder / "a"}),
                                 {.against = "time", .out = folder / "p"}),
               "--against time");
}

experiments::ExperimentFile named(const std::string& title, std::int64_t decisions) {
  experiments::ExperimentFile experiment;
  experiment.title = title;
  experiment.decisions = decisions;
  return experiment;
}

TEST(Experiment, DistancesAreThoseOfTheTwentiethOfTheBudgetThatEndsThere) {
  TemporaryFolder folder;
  write_run(folder / "arm" / "1", 1);
  write_run(folder / "arm" / "2", 3);
  const auto results = experiments::results_of(
      experiments::arms_of({folder / "arm" / "1", folder / "arm" / "2"}), 10'000);
  ASSERT_EQ(results.size(), 1u);
  for (std::size_t k = 0; k < experiments::kBudgetShares.size(); ++k) {
    EXPECT_DOUBLE_EQ(results[0].distance_m[k][0], 10 * experiments::kBudgetShares[k]);
    EXPECT_DOUBLE_EQ(results[0].distance_m[k][1], 30 * experiments::kBudgetShares[k]);
  }
}

TEST(Experiment, WhereNothingWasEvaluatedNearAShareItIsTheLastBefore) {
  TemporaryFolder folder;
  write_run(folder / "arm" / "1", 1);  // evaluated every 1000, 4 at 4000
  const auto results = experiments::results_of(experiments::arms_of({folder / "arm" / "1"}), 9'400);
  EXPECT_DOUBLE_EQ(results[0].distance_m[3][0], 4);  // half of it: 4277 to 4747
  const auto short_budget =
      experiments::results_of(experiments::arms_of({folder / "arm" / "1"}), -1);
  EXPECT_THAT(experiments::experiment_report(named("T", -1), short_budget, ""),
              ::testing::HasSubstr("| arm | – |"));
}

TEST(Experiment, TimesAreThoseOfTheFirstEvaluationThatReachedADistance) {
  TemporaryFolder folder;
  write_run(folder / "arm" / "1", 1);
  write_run(folder / "arm" / "2", 3);
  const auto results = experiments::results_of(
      experiments::arms_of({folder / "arm" / "1", folder / "arm" / "2"}), 10'000);
  EXPECT_EQ(results[0].reached[0][0]->decisions, 5000);  // 5 m
  EXPECT_EQ(results[0].reached[0][0]->wall_s, 300);
  EXPECT_EQ(results[0].reached[1][1]->decisions, 4000);  // 10 m: 12 is the first
  EXPECT_FALSE(results[0].reached[2][0]);                // 15 m: ends at 10
  EXPECT_THAT(experiments::experiment_report(named("Title", 10'000), results, "stride experiment"),
              ::testing::HasSubstr("| arm | 4 ± 1 k; 3.5 ± 1.5 min"));
}

experiments::ArmResult ended_at(const std::string& label, const std::vector<double>& distances_m) {
  experiments::ArmResult arm;
  arm.label = label;
  arm.distance_m.back() = distances_m;
  return arm;
}

TEST(Experiment, AVerdictNeedsAnIntervalThatExcludesOne) {
  const auto verdict = [](const std::vector<double>& better) {
    return experiments::verdict_on({.text = "b is better", .better = "b", .than = "a"},
                                   {ended_at("a", {10, 11, 12, 10, 9}), ended_at("b", better)});
  };
  EXPECT_EQ(verdict({20, 23, 24, 19, 18}).word, "holds");
  EXPECT_EQ(verdict({5, 5, 6, 5, 4}).word, "the opposite holds");
  EXPECT_EQ(verdict({20, 5, 14, 9, 10}).word, "undecided");
  EXPECT_EQ(verdict({-1, 5, 14, 9, 10}).word, "undecided") << "no ratio";
  const auto [ratio, difference, pairs, word] = verdict({20, 23, 24, 19, 18});
  EXPECT_EQ(pairs, 5u);
  EXPECT_NEAR(difference.mean_m, 10.4, 1e-9);
  EXPECT_GT(ratio.bootstrap_low, ratio.low) << "five pairs: Student's is the wider one";
  EXPECT_LT(ratio.bootstrap_high, ratio.high);
  EXPECT_NEAR(ratio.detectable(), ratio.ratio / ratio.low, 1e-12);
}

TEST(Experiment, WhereTheControlIsNothingTheDifferenceDecides) {
  const auto word = [](const std::vector<double>& better) {
    return experiments::verdict_on({.text = "b jumps farther", .better = "b", .than = "a"},
                                   {ended_at("a", {0, 0, 0.1, 0, 0}), ended_at("b", better)})
        .word;
  };
  EXPECT_EQ(word({0.5, 0.6, 0.55, 0.4, 0.5}), "holds");
  EXPECT_EQ(word({0, 0, 0.9, 0, 0}), "undecided");
  const experiments::PairedDifference spread = experiments::paired_difference({1, 3}, {0, 0});
  EXPECT_NEAR(spread.mean_m, 2, 1e-12);  // t(1) = 12.7062, s/√2 = 1
  EXPECT_NEAR(spread.high_m, 2 + 12.7062, 1e-4);
  EXPECT_TRUE(std::isnan(experiments::paired_difference({1}, {1}).low_m));
}

TEST(Experiment, OfJumpsSpeaksOfTheirLength) {
  experiments::ExperimentFile experiment = named("Jumps", 10'000);
  experiment.claim = {.text = "b jumps farther", .better = "b", .than = "a"};
  experiments::ExperimentArm arm;
  arm.name = "a";
  arm.train.environment.task.movement = "jump";
  arm.train.environment.task.name = "long-jump";
  arm.train.run.decisions = 10'000;
  experiment.arms = {arm};
  std::vector<experiments::ArmResult> results{ended_at("a", {0, 0, 0}),
                                              ended_at("b", {0.5, 0.6, 0.7})};
  for (experiments::ArmResult& each : results)
    for (std::size_t k = 0; k + 1 < each.distance_m.size(); ++k) each.distance_m[k] = {0, 0, 0};
  const std::string text = experiments::experiment_report(experiment, results, "");
  for (const char* expected :
       {"Length of the jump (m) without noise", "**holds**: b less a after 10 k decisions 0.60 (",
        "Difference to a, m, mean over paired seeds", "| 0.2 m | 0.4 m |",
        "- b: 0.50 0.60 0.70; 0.10", "![length of the jump against decisions]"})
    EXPECT_THAT(text, ::testing::HasSubstr(expected));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("istance")));
}

TEST(Experiment, RatioOverPairedSeedsHasStudentsInterval) {
  const experiments::PairedRatio same = experiments::paired_ratio({2, 4, 8}, {1, 2, 4});
  EXPECT_NEAR(same.ratio, 2, 1e-12);
  EXPECT_NEAR(same.low, 2, 1e-9);
  const experiments::PairedRatio spread =
      experiments::paired_ratio({std::exp(1.0), std::exp(3.0)}, {1, 1});
  EXPECT_NEAR(std::log(spread.ratio), 2, 1e-12);  // t(1) = 12.7062, s/√2 = 1
  EXPECT_NEAR(std::log(spread.high), 2 + 12.7062, 1e-4);
  const double e = std::exp(1.0);
  const experiments::PairedRatio thirteen = experiments::paired_ratio(
      {e, e, e, e, e, e, 1, 1 / e, 1 / e, 1 / e, 1 / e, 1 / e, 1 / e}, std::vector<double>(13, 1));
  EXPECT_NEAR(std::log(thirteen.high), 2.1788 / std::sqrt(13.0), 1e-4);  // t(12) = 2.1788, s = 1
  EXPECT_TRUE(std::isnan(experiments::paired_ratio({1}, {1}).ratio));
}

}  // namespace
}  // namespace stride
