#include "train/bench.h"

#include <gtest/gtest.h>
#include <malloc.h>

namespace stride {
namespace {

TEST(Bench, RunsBothEnginesAndAccountsForEveryEpisode) {
  const Model model = load_osim(default_model_file());
  BenchOptions options;
  options.steps = 300;
  const std::vector<BenchResult> results = bench({"simbody", "planar"}, model, options);
  ASSERT_EQ(results.size(), 2u);
  for (const BenchResult& r : results) {
    EXPECT_EQ(r.steps, 300);
    EXPECT_GT(r.falls, 0);
    EXPECT_EQ(r.failures, 0) << r.first_failure;
    EXPECT_GT(r.evaluations_per_step(), 4);
    EXPECT_GT(r.us_per_evaluation(), 0);
    EXPECT_DOUBLE_EQ(r.realtime_factor(), r.steps_per_s() * 0.01);
  }
}

TEST(Bench, TheSameSeedIsTheSameRun) {
  const Model model = load_osim(default_model_file());
  BenchOptions options;
  options.steps = 2000;
  options.threads = 2;
  const BenchResult a = bench({"planar"}, model, options)[0];
  const BenchResult b = bench({"planar"}, model, options)[0];
  EXPECT_EQ(a.steps, 4000);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.falls, b.falls);
  options.seed = 9;
  EXPECT_NE(bench({"planar"}, model, options)[0].evaluations, a.evaluations);
}

// The million steps of `stride bench --steps 1000000 --obstacles 20`, in short.
TEST(Soak, RandomExcitationAmongObstaclesNeverFailsAndKeepsItsMemory) {
  const Model model = load_osim(default_model_file());
  BenchOptions options;
  options.steps = 10000;
  options.obstacles = 20;
  bench({"planar"}, model, options);
  const std::size_t before = mallinfo2().uordblks;
  const BenchResult r = bench({"planar"}, model, options)[0];
  EXPECT_EQ(r.failures, 0) << r.first_failure;
  EXPECT_GT(r.falls, 50);
  EXPECT_LE(mallinfo2().uordblks, before + 65536);
}

TEST(Soak, TheCompetitionsDroppedContactsDoNotTrapTheIntegrator) {
  BenchOptions options;
  options.steps = 10000;
  options.obstacles = 3;
  options.engine.drop_contacts = options.engine.nominal_obstacles = true;
  const BenchResult r = bench({"planar"}, load_osim(default_model_file()), options)[0];
  EXPECT_EQ(r.failures, 0) << r.first_failure;
}

TEST(AccuracyTable, ErrorFallsWithTheAccuracyAndMeetsTheDefaultsPromise) {
  const Model model = load_osim(default_model_file());
  AccuracyOptions options;
  options.rollouts = 20;
  options.engines = {"planar"};
  options.accuracies = {1e-2, 1e-3, 1e-5};
  const std::vector<AccuracyRow> rows = accuracy_table(model, options);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_LE(rows[0].worst_error, 1e-2);
  EXPECT_LE(rows[1].worst_error, 1e-3);  // what the default accuracy is chosen for
  EXPECT_LE(rows[2].worst_error, 1e-5);
  EXPECT_LT(rows[0].evaluations_per_step, rows[1].evaluations_per_step);
}

}  // namespace
}  // namespace stride
