#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "calibrate/model.h"
#include "tests/train/reference.h"
#include "train/simulation/engine.h"
#include "train/simulation/runner_layout.h"

namespace stride {

/// A test that every engine must pass.
class EachEngine : public testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<Engine> engine(const EngineOptions& options = {}) const {
    return make_engine(GetParam(), model_, options);
  }
  /// Bones under gravity alone: no contact, no limits, muscles without force.
  std::unique_ptr<Engine> skeleton(const EngineOptions& options = {}) const {
    Model bare = model_;
    bare.contacts.clear();
    bare.limits.clear();
    auto made = make_engine(GetParam(), bare, options);
    for (int i = 0; i < kMuscles; ++i) made->set_strength(i, 0);
    return made;
  }
  const Model model_ = load_osim(default_model_file());
};

#define INSTANTIATE_FOR_EACH_ENGINE(Suite)                                  \
  INSTANTIATE_TEST_SUITE_P(Engines, Suite, testing::ValuesIn(kEngineNames), \
                           [](const auto& each) { return std::string(each.param); })

/// A row of static_poses.csv, muscles as in the model's file.
inline RunnerState recorded_pose(const Model& model, const Reference& poses, std::size_t row) {
  RunnerState state = default_state(model);
  for (int i = 0; i < kCoordinates; ++i) {
    const std::string name = model.coordinates[runner_layout(model).coordinate[i]].name;
    state.q[i] = poses.number(row, name + "_rad_or_m");
    state.u[i] = poses.number(row, name + "_vel_rad_s_or_m_s");
  }
  return state;
}

}  // namespace stride
