#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "tests/train/reference.h"
#include "train/simulation/engine/engine.h"
#include "train/simulation/engine/runner_layout.h"

namespace stride {

/// Excitations of the recorded rollouts, one a step of 0.01 s: `zero`, `all005`, `all1`,
/// `onehot_<muscle>`, `random_seed1`.
inline std::vector<simulation::Excitations> recorded_excitations(const std::string& scenario) {
  std::vector<simulation::Excitations> all(100, simulation::Excitations{});
  if (scenario == "zero") return all;
  for (simulation::Excitations& each : all) {
    if (scenario == "all005") each.fill(0.05);
    if (scenario == "all1") each.fill(1);
    for (int i = 0; i < simulation::kMuscles; ++i)
      if (scenario == "onehot_" + simulation::muscle_names()[i]) each[i] = 1;
  }
  if (scenario != "random_seed1") return all;
  const Reference actions("actions_random_seed1.csv");
  for (std::size_t step = 0; step < all.size(); ++step)
    for (int i = 0; i < simulation::kMuscles; ++i)
      all[step][i] = actions.number(step, "u_" + simulation::muscle_names()[i]);
  return all;
}

/// The nine coordinates of a row of a recorded rollout.
inline std::array<double, simulation::kCoordinates> recorded_coordinates(const Reference& rollout,
                                                                         std::size_t row) {
  const char* names[] = {"pelvis_tilt_rad", "pelvis_tx_m", "pelvis_ty_m",
                         "hip_r_rad",       "knee_r_rad",  "ankle_r_rad",
                         "hip_l_rad",       "knee_l_rad",  "ankle_l_rad"};
  std::array<double, simulation::kCoordinates> q;
  for (int i = 0; i < simulation::kCoordinates; ++i) q[i] = rollout.number(row, names[i]);
  return q;
}

}  // namespace stride
