#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "train/simulation/engine/engine.h"

namespace stride::competition {

/// The variants of the environment where the competition's had faults.
///
///                         clean                       nips2017
///   fibres at the start   in equilibrium              of the file, else 0.1 m        (O1)
///   contacts of a foot    every one counts            one that pulls drops the next  (O2)
///   left strength         of iliopsoas_l              of glut_max_l                  (O3)
///   obstacles             of the size observed        spheres of 0.1 m, K = 1e7 N/m^1.5  (O4)
///   unused obstacles      are not there               lie at (0, -0.1) and touch     (O5)
///   centre of mass        of the runner               with 0.1 g an obstacle
///
/// Neither repeats the competition's stale observations of body positions.
enum class Rules { clean, nips2017 };

/// Throws Error with the list of rules.
Rules rules_named(std::string_view name);
std::string_view name(Rules rules);

/// The random scene of an episode.
struct Scene {
  std::vector<simulation::Obstacle> obstacles;  // in the order of x
  double strength_r = 1, strength_l = 1;        // of the psoas, of its maximum isometric force
};

/// The competition's draw at difficulty 0 (nothing), 1 (obstacles) or 2 (strengths, too): for seeds
/// below 2^32 the very numbers that `RunEnv.reset(difficulty, seed)` gives. The first three
/// obstacles lie 1 to 5 m ahead, each further one (of at most 20) 2 to 4 m after the last.
/// Throws Error if difficulty or max_obstacles is out of range.
Scene draw_scene(std::uint64_t seed, int difficulty, int max_obstacles);

/// Throws Error naming the option that is out of range.
void check_scene_options(int difficulty, int max_obstacles);

/// `options` with the contact options of the rules.
simulation::EngineOptions under(Rules rules, simulation::EngineOptions options);

/// Sets obstacles and strengths of the engine; under nips2017 unused obstacles up to
/// `max_obstacles` are parked at (0, -0.1).
void arrange(const Scene& scene, Rules rules, int max_obstacles, simulation::Engine& engine);

/// Sets the rules' initial state: the file's default pose, fibres by the rules.
void set_initial_state(Rules rules, simulation::Engine& engine);

/// The competition's reward of a step, by parts; their sum is the reward.
struct Reward {
  double forward = 0;   // Δ pelvis_tx, m
  double ligament = 0;  // -1e-7 · √(Σ torque²) over the joint limits, at the end of the step

  double sum() const { return forward + ligament; }
};

Reward step_reward(double previous_pelvis_x, const simulation::RunnerState& state,
                   const simulation::RunnerKinematics& kinematics);

/// Below this height of the pelvis, m, the runner has fallen.
inline constexpr double kFallHeight_m = 0.65;
inline bool has_fallen(const simulation::RunnerState& state) {
  return state.q[simulation::kPelvisY] < kFallHeight_m;
}

inline constexpr double kStep_s = 0.01;
inline constexpr int kMaxSteps = 1000;

}  // namespace stride::competition
