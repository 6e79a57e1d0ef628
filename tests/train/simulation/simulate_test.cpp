#include "train/simulation/simulate.h"

#include <gtest/gtest.h>

#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"
#include "tests/train/engines.h"
#include "tests/train/rollout.h"
#include "train/simulation/competition/sensors.h"

namespace stride {
namespace {

class Simulate : public EachEngine {
 protected:
  simulation::SimulateOptions options() const {
    simulation::SimulateOptions options;
    options.engine = GetParam();
    options.accuracy = 1e-7;
    return options;
  }
};
INSTANTIATE_FOR_EACH_ENGINE(Simulate);

TEST_P(Simulate, WritesTheInitialStateAndEveryStepByName) {
  const std::vector<simulation::Excitations> excitations(3, simulation::Excitations{});
  const simulation::Simulation run = simulation::simulate(model_, excitations, options());
  const Table& table = run.table;
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.columns[0], "time_s");
  EXPECT_EQ(table.columns[9], "ankle_angle_l");
  EXPECT_EQ(table.columns[18], "ankle_angle_l_u");
  for (int i = 0; i < competition::Sensors::kCompetition; ++i)
    EXPECT_TRUE(table.has_column(competition::Sensors::names()[i]))
        << competition::Sensors::names()[i];
  EXPECT_EQ(table.columns.size(), 1u + competition::Sensors::kCompetition);
  EXPECT_EQ(table.rows[0][table.column("pelvis_ty")], 0.91);
  EXPECT_EQ(table.rows[0][table.column("pelvis_y")], 0.91);
  EXPECT_EQ(table.rows[3][0], 0.03);
}

TEST_P(Simulate, FollowsTheFibresThatAreAskedFor) {
  const auto excitations = recorded_excitations("all005");
  const auto knee_error = [&](const char* file, simulation::SimulateOptions options) {
    const Reference recorded(file);
    const Table table = simulation::simulate(model_, excitations, options).table;
    return std::abs(table.rows[10][table.column("knee_angle_r")] -
                    recorded.number(10, "knee_r_rad"));
  };
  simulation::SimulateOptions chosen = options();
  EXPECT_LT(knee_error("rollout_noblocks_eqstart_all005.csv", chosen), 1e-5);
  chosen.equilibrate = false;
  EXPECT_LT(knee_error("rollout_noblocks_all005.csv", chosen), 1e-5);
  chosen = options();
  chosen.rules = competition::Rules::nips2017;
  EXPECT_LT(knee_error("rollout_competition_all005.csv", chosen), 1e-4);
}

TEST_P(Simulate, FollowsAFallenRunnerToTheEnd) {
  simulation::SimulateOptions quick = options();
  quick.accuracy = 1e-3;
  auto excitations = recorded_excitations("onehot_glut_max_r");
  excitations.resize(60);
  const simulation::Simulation run = simulation::simulate(model_, excitations, quick);
  EXPECT_EQ(run.table.rows.size(), 61u);
  ASSERT_TRUE(run.fell_at_s);
  EXPECT_NEAR(*run.fell_at_s, 0.56, 1e-9);  // as OpenSim's
  EXPECT_EQ(run.failure, "");
}

class ExcitationFile : public testing::Test {
 protected:
  ExcitationFile() {
    for (const std::string& name : simulation::muscle_names())
      header_ += (header_.empty() ? "" : ",") + name;
    row_ = "0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5";
  }
  std::filesystem::path file(const std::string& content) {
    write_file_atomically(folder_ / "e.csv", content);
    return folder_ / "e.csv";
  }
  TemporaryFolder folder_;
  std::string header_, row_;
};

TEST_F(ExcitationFile, MayHaveItsColumnsInAnyOrderAndATime) {
  std::string reversed = "time_s";
  for (int i = simulation::kMuscles - 1; i >= 0; --i)
    reversed += "," + simulation::muscle_names()[i];
  const auto read = simulation::load_excitations(
      file(reversed + "\n0,0.17,0.16,0.15,0.14,0.13,0.12,0.11,0.1,0.09,0.08,0.07,0.06,0.05,0.04,"
                      "0.03,0.02,0.01,1.5\n"));
  ASSERT_EQ(read.steps.size(), 1u);
  EXPECT_EQ(read.steps[0][17], 0.17);
  EXPECT_EQ(read.steps[0][1], 0.01);
  EXPECT_EQ(read.steps[0][0], 1);
  EXPECT_EQ(read.clipped, 1);
}

TEST_F(ExcitationFile, NamesWhatIsWrongWithIt) {
  const std::string rest = header_.substr(header_.find(','));
  EXPECT_ERROR(simulation::load_excitations(file("hams" + rest + "\n" + row_ + "\n")),
               "has no column hamstrings_r");
  EXPECT_ERROR(simulation::load_excitations(file(header_ + ",biceps\n" + row_ + ",0\n")),
               "column biceps: there is no such muscle");
  EXPECT_ERROR(simulation::load_excitations(file(header_ + ",soleus_r\n" + row_ + ",0\n")),
               "twice");
  EXPECT_ERROR(
      simulation::load_excitations(file(header_ + "\n" + row_ + "\nnan" + row_.substr(3) + "\n")),
      "step 2, hamstrings_r: empty or NaN: must be a number in [0, 1]");
  EXPECT_ERROR(simulation::load_excitations(file(header_ + "\n")), "has no rows");
  EXPECT_ERROR(simulation::load_excitations(folder_ / "none.csv"), "no such file");
}

TEST_F(ExcitationFile, ObstaclesAreSortedAndChecked) {
  const auto obstacles =
      simulation::load_obstacles(file("y_m,x_m,radius_m\n0,3,0.1\n0.01,2,0.2\n"));
  ASSERT_EQ(obstacles.size(), 2u);
  EXPECT_EQ(obstacles[0].x_m, 2);
  EXPECT_EQ(obstacles[0].radius_m, 0.2);
  EXPECT_ERROR(simulation::load_obstacles(file("x_m,y_m,radius_m\n1,0,0\n")), "radius_m > 0");
  EXPECT_ERROR(simulation::load_obstacles(file("x_m,y_m\n1,0\n")), "radius_m");
}

}  // namespace
}  // namespace stride
