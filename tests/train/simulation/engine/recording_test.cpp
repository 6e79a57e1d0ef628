#include "train/simulation/engine/recording.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibrate/osim/model.h"
#include "extract/io/data_file.h"
#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"
#include "train/simulation/make_engine.h"

namespace stride::simulation {
namespace {

TEST(Recording, IsOneRunStepByStep) {
  const Recording run = load_recording(data_file("train/agents/stride/running.csv"));
  ASSERT_EQ(run.states.size(), 300U);
  const auto engine = make_engine("planar", osim::load_osim(osim::default_model_file()));
  for (std::size_t i = 0; i + 1 < run.states.size(); ++i) {
    engine->set_state(run.states[i]);
    ASSERT_TRUE(engine->advance(run.excitations[i], 0.01).ok);
    for (int c = 0; c < kCoordinates; ++c)
      EXPECT_NEAR(engine->state().q[c], run.states[i + 1].q[c], 1e-3) << "step " << i;
  }
  EXPECT_GT(run.states.back().q[1] - run.states.front().q[1], 14);  // it runs 5 m/s
}

TEST(Recording, WhatIsMissingIsNamed) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.csv", "# stride recording 1\ntime_s\n");
  EXPECT_ERROR(load_recording(folder / "a.csv"), "has no steps");
  write_file_atomically(folder / "b.csv", "# stride recording 1\ntime_s\n0\n");
  EXPECT_ERROR(load_recording(folder / "b.csv"), "pelvis_tilt");
}

}  // namespace
}  // namespace stride::simulation
