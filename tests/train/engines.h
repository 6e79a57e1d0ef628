#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "calibrate/osim/model.h"
#include "tests/train/reference.h"
#include "train/simulation/engine/engine.h"
#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/make_engine.h"

namespace stride {

/// A test that every engine must pass.
class EachEngine : public testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<simulation::Engine> engine(const simulation::EngineOptions& options = {}) const {
    return simulation::make_engine(GetParam(), model_, options);
  }
  /// Bones under gravity alone: no contact, no limits, muscles without force.
  std::unique_ptr<simulation::Engine> skeleton(
      const simulation::EngineOptions& options = {}) const {
    osim::Model bare = model_;
    bare.contacts.clear();
    bare.limits.clear();
    auto made = simulation::make_engine(GetParam(), bare, options);
    for (int i = 0; i < simulation::kMuscles; ++i) made->set_strength(i, 0);
    return made;
  }
  const osim::Model model_ = osim::load_osim(osim::default_model_file());
};

#define INSTANTIATE_FOR_EACH_ENGINE(Suite)                                              \
  INSTANTIATE_TEST_SUITE_P(Engines, Suite, testing::ValuesIn(simulation::kEngineNames), \
                           [](const auto& each) { return std::string(each.param); })

/// A row of static_poses.csv, muscles as in the model's file.
inline simulation::RunnerState recorded_pose(const osim::Model& model, const Reference& poses,
                                             std::size_t row) {
  simulation::RunnerState state = simulation::default_state(model);
  for (int i = 0; i < simulation::kCoordinates; ++i) {
    const std::string name = model.coordinates[simulation::runner_layout(model).coordinate[i]].name;
    state.q[i] = poses.number(row, name + "_rad_or_m");
    state.u[i] = poses.number(row, name + "_vel_rad_s_or_m_s");
  }
  return state;
}

}  // namespace stride
