#include "train/simulation/competition/sensors.h"

#include <algorithm>

#include "calibrate/runner/calibrated.h"
#include "extract/io/error.h"
#include "train/simulation/engine/runner_layout.h"

namespace stride::competition {
namespace {

constexpr const char* kBodies[] = {"head",    "pelvis",  "torso",   "toes_l",  "toes_r", "talus_l",
                                   "talus_r", "tibia_l", "tibia_r", "calcn_l", "calcn_r"};
constexpr std::size_t kBodiesOfTheCompetition = 7;

std::vector<std::string> all_names() {
  std::vector<std::string> all;
  const auto coordinates = [&](int first, int last, const char* suffix) {
    for (int i = first; i < last; ++i) all.push_back(std::string(kCoordinateNames[i]) + suffix);
  };
  coordinates(0, 3, ""), coordinates(0, 3, "_u");
  coordinates(3, 9, ""), coordinates(3, 9, "_u");
  for (const char* name : {"com_x", "com_y", "com_vx", "com_vy"}) all.emplace_back(name);
  const auto bodies = [&](std::size_t first, std::size_t last, bool positions, bool velocities) {
    for (std::size_t i = first; i < last; ++i) {
      const std::string body = kBodies[i];
      if (positions) all.push_back(body + "_x"), all.push_back(body + "_y");
      if (velocities) all.push_back(body + "_vx"), all.push_back(body + "_vy");
    }
  };
  bodies(0, kBodiesOfTheCompetition, true, false);
  for (const char* name :
       {"strength_psoas_l", "strength_psoas_r", "obstacle_x", "obstacle_y", "obstacle_radius"})
    all.emplace_back(name);
  bodies(0, kBodiesOfTheCompetition, false, true);
  bodies(kBodiesOfTheCompetition, std::size(kBodies), true, true);
  for (const std::string& muscle : simulation::muscle_names())
    all.push_back("activation_" + muscle);
  return all;
}

}  // namespace

Sensors::Sensors(const osim::Model& model) : mass_kg_(model.mass_kg()) {
  for (const char* name : kBodies) {
    bodies_.push_back(model.body(name));
    require(bodies_.back() >= 0, "model {}: has no body {}; a runner needs {}", model.name, name,
            fmt::join(kBodies, ", "));
  }
}

const std::vector<std::string>& Sensors::names() {
  static const std::vector<std::string> names = all_names();
  return names;
}

simulation::Obstacle next_obstacle(const Scene& scene, double pelvis_x_m) {
  for (const simulation::Obstacle& each : scene.obstacles)
    if (each.x_m + each.radius_m >= pelvis_x_m)
      return {each.x_m - pelvis_x_m, each.y_m, each.radius_m};
  return {100, 0, 0};
}

void Sensors::read(const simulation::RunnerState& state,
                   const simulation::RunnerKinematics& kinematics, const Scene& scene, Rules rules,
                   int max_obstacles, double* values) const {
  const auto put = [&](std::initializer_list<double> some) {
    values = std::copy(some.begin(), some.end(), values);
  };
  const auto& q = state.q;
  const auto& u = state.u;
  values = std::copy(q.begin(), q.begin() + 3, values);
  values = std::copy(u.begin(), u.begin() + 3, values);
  values = std::copy(q.begin() + 3, q.end(), values);
  values = std::copy(u.begin() + 3, u.end(), values);

  simulation::PlanarVector com = kinematics.com, com_velocity = kinematics.com_velocity;
  if (rules == Rules::nips2017) {  // each of the competition's obstacles weighs 0.1 g
    constexpr double kObstacle_kg = 1e-4;
    const int used = static_cast<int>(scene.obstacles.size());
    const int parked = std::max(max_obstacles - used, 0);
    const double mass = mass_kg_ + kObstacle_kg * (used + parked);
    double x = 0, y = -0.1 * parked;
    for (const simulation::Obstacle& each : scene.obstacles) x += each.x_m, y += each.y_m;
    com = {(mass_kg_ * com.x + kObstacle_kg * x) / mass,
           (mass_kg_ * com.y + kObstacle_kg * y) / mass};
    com_velocity = {mass_kg_ * com_velocity.x / mass, mass_kg_ * com_velocity.y / mass};
  }
  put({com.x, com.y, com_velocity.x, com_velocity.y});

  const auto frame = [&](std::size_t i) -> const simulation::RunnerKinematics::Frame& {
    return kinematics.bodies[bodies_[i]];
  };
  for (std::size_t i = 0; i < kBodiesOfTheCompetition; ++i)
    put({frame(i).position.x, frame(i).position.y});
  const simulation::Obstacle next = next_obstacle(scene, q[simulation::kPelvisX]);
  put({scene.strength_l, scene.strength_r, next.x_m, next.y_m, next.radius_m});
  for (std::size_t i = 0; i < kBodiesOfTheCompetition; ++i)
    put({frame(i).velocity.x, frame(i).velocity.y});
  for (std::size_t i = kBodiesOfTheCompetition; i < bodies_.size(); ++i)
    put({frame(i).position.x, frame(i).position.y, frame(i).velocity.x, frame(i).velocity.y});
  std::copy(state.activation.begin(), state.activation.end(), values);
}

}  // namespace stride::competition
