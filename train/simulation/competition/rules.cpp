#include "train/simulation/competition/rules.h"

#include <algorithm>
#include <cmath>

#include "extract/io/error.h"
#include "train/simulation/competition/numpy_random.h"
#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/laws/contact.h"

namespace stride::competition {
namespace {

constexpr int kObstaclesNearby = 3, kMostObstacles = 20;

int muscle_index(std::string_view wanted) {
  const auto& names = simulation::muscle_names();
  return static_cast<int>(std::find(names.begin(), names.end(), wanted) - names.begin());
}

}  // namespace

Rules rules_named(std::string_view wanted) {
  for (Rules rules : {Rules::clean, Rules::nips2017})
    if (name(rules) == wanted) return rules;
  throw Error(
      fmt::format("rules \"{}\": there are none of this name; rules are clean, nips2017", wanted));
}

std::string_view name(Rules rules) { return rules == Rules::clean ? "clean" : "nips2017"; }

void check_scene_options(int difficulty, int max_obstacles) {
  require(difficulty >= 0 && difficulty <= 2,
          "difficulty = {}: must be 0 (flat), 1 (obstacles) or 2 (obstacles and weak muscles)",
          difficulty);
  require(max_obstacles >= 0 && max_obstacles <= kMostObstacles,
          "max_obstacles = {}: must be 0 to {}", max_obstacles, kMostObstacles);
}

Scene draw_scene(std::uint64_t seed, int difficulty, int max_obstacles) {
  check_scene_options(difficulty, max_obstacles);
  Scene scene;
  if (difficulty == 0) return scene;
  NumpyRandom random(static_cast<std::uint32_t>(seed ^ (seed >> 32)));
  const auto draw = [&](int count, double low, double high, bool after_each_other) {
    const std::size_t first = scene.obstacles.size();
    double gaps = 0;
    for (int i = 0; i < count; ++i) {
      if (after_each_other) gaps += random.uniform(2, 4);
      scene.obstacles.push_back({after_each_other ? gaps + 5 : random.uniform(1, 5), 0, 0});
    }
    for (auto it = scene.obstacles.begin() + first; it != scene.obstacles.end(); ++it)
      it->y_m = random.uniform(low, high);
    for (auto it = scene.obstacles.begin() + first; it != scene.obstacles.end(); ++it) {
      it->radius_m = 0.05 + random.exponential(0.05);
      it->y_m *= it->radius_m;
    }
  };
  const int nearby = std::min(kObstaclesNearby, max_obstacles);
  draw(nearby, -0.25, 0.25, false);
  draw(max_obstacles - nearby, -0.05, 0.25, true);
  if (difficulty == 2) {
    scene.strength_r = std::max(0.5, 1 - random.normal(0, 0.1));
    scene.strength_l = std::max(0.5, 1 - random.normal(0, 0.1));
  }
  std::sort(
      scene.obstacles.begin(), scene.obstacles.end(),
      [](const simulation::Obstacle& a, const simulation::Obstacle& b) { return a.x_m < b.x_m; });
  return scene;
}

simulation::EngineOptions under(Rules rules, simulation::EngineOptions options) {
  options.drop_contacts = options.nominal_obstacles = rules == Rules::nips2017;
  return options;
}

void arrange(const Scene& scene, Rules rules, int max_obstacles, simulation::Engine& engine) {
  std::vector<simulation::Obstacle> obstacles = scene.obstacles;
  if (rules == Rules::nips2017)
    obstacles.resize(std::max(obstacles.size(), static_cast<std::size_t>(max_obstacles)),
                     {0, -0.1, laws::kNominalObstacleRadius_m});
  engine.set_obstacles(obstacles);
  const int left = muscle_index(rules == Rules::clean ? "iliopsoas_l" : "glut_max_l");
  engine.set_strength(muscle_index("iliopsoas_r"), scene.strength_r);
  engine.set_strength(left, scene.strength_l);
}

void set_initial_state(Rules rules, simulation::Engine& engine) {
  engine.set_state(simulation::default_state(engine.model()));
  if (rules == Rules::clean) engine.equilibrate_fibers();
}

Reward step_reward(double previous_pelvis_x, const simulation::RunnerState& state,
                   const simulation::RunnerKinematics& kinematics) {
  double squares = 0;
  for (double torque : kinematics.limit_torque_Nm) squares += torque * torque;
  return {state.q[1] - previous_pelvis_x, -1e-7 * std::sqrt(squares)};
}

}  // namespace stride::competition
