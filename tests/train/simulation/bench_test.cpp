#include "train/simulation/bench.h"

#include <gtest/gtest.h>
#include <malloc.h>

namespace stride {
namespace {

TEST(Bench, RunsBothEnginesAndAccountsForEveryEpisode) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  simulation::BenchOptions options;
  options.steps = 300;
  const std::vector<simulation::BenchResult> results =
      simulation::bench({"simbody", "planar"}, model, options);
  ASSERT_EQ(results.size(), 2u);
  for (const simulation::BenchResult& r : results) {
    EXPECT_EQ(r.steps, 300);
    EXPECT_GT(r.falls, 0);
    EXPECT_EQ(r.failures, 0) << r.first_failure;
    EXPECT_GT(r.evaluations_per_step(), 4);
    EXPECT_GT(r.us_per_evaluation(), 0);
    EXPECT_DOUBLE_EQ(r.realtime_factor(), r.steps_per_s() * 0.01);
  }
}

TEST(Bench, TheSameSeedIsTheSameRun) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  simulation::BenchOptions options;
  options.steps = 2000;
  options.threads = 2;
  const simulation::BenchResult a = simulation::bench({"planar"}, model, options)[0];
  const simulation::BenchResult b = simulation::bench({"planar"}, model, options)[0];
  EXPECT_EQ(a.steps, 4000);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.falls, b.falls);
  options.seed = 9;
  EXPECT_NE(simulation::bench({"planar"}, model, options)[0].evaluations, a.evaluations);
}

// The million steps of `stride bench --steps 1000000 --obstacles 20`, in short.
TEST(Soak, RandomExcitationAmongObstaclesNeverFailsAndKeepsItsMemory) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  simulation::BenchOptions options;
  options.steps = 10000;
  options.obstacles = 20;
  simulation::bench({"planar"}, model, options);
  const std::size_t before = mallinfo2().uordblks;
  const simulation::BenchResult r = simulation::bench({"planar"}, model, options)[0];
  EXPECT_EQ(r.failures, 0) << r.first_failure;
  EXPECT_GT(r.falls, 50);
  EXPECT_LE(mallinfo2().uordblks, before + 65536);
}

TEST(Soak, TheCompetitionsDroppedContactsDoNotTrapTheIntegrator) {
  simulation::BenchOptions options;
  options.steps = 10000;
  options.obstacles = 3;
  options.engine.drop_contacts = options.engine.nominal_obstacles = true;
  const simulation::BenchResult r =
      simulation::bench({"planar"}, osim::load_osim(osim::default_model_file()), options)[0];
  EXPECT_EQ(r.failures, 0) << r.first_failure;
}

TEST(AccuracyTable, ErrorFallsWithTheAccuracyAndMeetsTheDefaultsPromise) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  simulation::AccuracyOptions options;
  options.rollouts = 20;
  options.engines = {"planar"};
  options.accuracies = {1e-2, 1e-3, 1e-5};
  const std::vector<simulation::AccuracyRow> rows = simulation::accuracy_table(model, options);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_LE(rows[0].worst_error, 1e-2);
  EXPECT_LE(rows[1].worst_error, 1e-3);  // what the default accuracy is chosen for
  EXPECT_LE(rows[2].worst_error, 1e-5);
  EXPECT_LT(rows[0].evaluations_per_step, rows[1].evaluations_per_step);
}

}  // namespace
}  // namespace stride
