#include "train/simulation/laws/runner_forces.h"

#include <algorithm>
#include <cmath>

#include "extract/io/error.h"

namespace stride::laws {

RunnerForces::RunnerForces(const osim::Model& model, const simulation::RunnerLayout& layout,
                           const simulation::EngineOptions& options)
    : model_(model), options_(options) {
  std::size_t longest = 0;
  for (int i : layout.muscle) {
    muscles_.push_back({MuscleLaw(model_.muscles[i]), path_law(model_, model_.muscles[i])});
    longest = std::max(longest, model_.muscles[i].path.size());
  }
  nodes_.resize(longest);
  for (const osim::ContactForce& each : model_.contacts) {
    require(!options_.drop_contacts || each.spheres.size() == 2,
            "contact {}: has {} spheres; the rules nips2017 are known for two; use the rules clean",
            each.name, each.spheres.size());
    feet_.push_back({contact_law(each), model_.planes[each.plane].height_m, each.spheres});
  }
  for (const osim::CoordinateLimit& each : model_.limits)
    joint_limits_.push_back(
        {limit_law(each, model_.coordinates[each.coordinate].rotational), each.coordinate});
  result_.on_body.resize(model_.bodies.size());
  result_.on_coordinate.resize(model_.coordinates.size());
}

void RunnerForces::set_obstacles(const std::vector<simulation::Obstacle>& obstacles) {
  contact_obstacles_.clear();
  for (simulation::Obstacle each : obstacles) {
    if (options_.nominal_obstacles) each.radius_m = kNominalObstacleRadius_m;
    contact_obstacles_.push_back({each, obstacle_law(each.radius_m)});
  }
}

double RunnerForces::muscle_length(int muscle, const PlacedRunner& runner) {
  const int count = place_path(muscles_[muscle].path, runner.q.data(), runner.u.data(),
                               runner.frames, nodes_.data());
  return pull_path(nodes_.data(), count).length_m;
}

/// Adds a force at a point in axes of the ground to a body; forces on the ground (-1) are ignored.
/// The joints bear components out of the plane.
void RunnerForces::push(const PlacedRunner& runner, int body, const osim::Vec3& point, double fx,
                        double fy) {
  if (body < 0) return;
  const osim::Vec3& origin = runner.frames[body].origin_m;
  Wrench& sum = result_.on_body[body];
  sum.moment_Nm += (point[0] - origin[0]) * fy - (point[1] - origin[1]) * fx;
  sum.fx_N += fx;
  sum.fy_N += fy;
}

void RunnerForces::add_gravity(const PlacedRunner& runner) {
  for (int i = 0; i < static_cast<int>(model_.bodies.size()); ++i) {
    const osim::Body& body = model_.bodies[i];
    push(runner, i, runner.point(i, body.mass_center_m), body.mass_kg * model_.gravity_m_s2[0],
         body.mass_kg * model_.gravity_m_s2[1]);
  }
}

void RunnerForces::add_muscle(int i, const PlacedRunner& runner, double activation,
                              double fiber_length_m) {
  const MuscleOfRunner& muscle = muscles_[i];
  const int count =
      place_path(muscle.path, runner.q.data(), runner.u.data(), runner.frames, nodes_.data());
  const double length = pull_path(nodes_.data(), count).length_m;
  const MuscleForces forces = muscle_forces(muscle.law, activation, fiber_length_m, length);
  const double tension = muscle.strength * forces.tendon_force_N;
  result_.muscle_length_m[i] = length;
  result_.tendon_force_N[i] = tension;
  result_.fiber_velocity_m_s[i] = forces.fiber_velocity_m_s;
  for (int n = 0; n < count; ++n) {
    const PathNode& node = nodes_[n];
    push(runner, node.body, node.position_m, tension * node.pull[0], tension * node.pull[1]);
    if (node.coordinate >= 0)
      result_.on_coordinate[node.coordinate] += tension * pull_on_coordinate(node);
  }
}

/// Returns the ground's reaction on the foot.
simulation::PlanarVector RunnerForces::add_foot(const PlacedRunner& runner, const Foot& foot) {
  simulation::PlanarVector reaction;
  const auto sphere = [&](std::size_t n) -> const osim::ContactSphere& {
    return model_.spheres[foot.spheres[n % foot.spheres.size()]];
  };
  const auto centre = [&](const osim::ContactSphere& s) {
    return runner.point(s.body, s.location_m);
  };
  std::size_t first = 0;
  if (options_.drop_contacts && !first_sphere_is_swept_first(centre(sphere(0)), sphere(0).radius_m,
                                                             centre(sphere(1)), sphere(1).radius_m))
    first = 1;
  double kept = 1;  // share of the force of the contacts after one that pulls
  for (std::size_t n = first; n < first + foot.spheres.size(); ++n) {
    const osim::ContactSphere& obstacle_contact = sphere(n);
    osim::Vec3 point = centre(obstacle_contact);
    const double depth = obstacle_contact.radius_m - (point[1] - foot.floor_m);
    if (depth <= 0) continue;
    point[1] = foot.floor_m - depth / 2;
    const simulation::PlanarVector velocity = runner.velocity(obstacle_contact.body, point);
    const double normal =
        kept * normal_force(foot.law, obstacle_contact.radius_m, depth, -velocity.y);
    if (normal <= 0) {
      if (options_.drop_contacts) kept = 1 - options_.drop_share;
      continue;
    }
    const double friction = friction_force(foot.law, normal, std::abs(velocity.x));
    const double along = -std::copysign(friction, velocity.x);
    push(runner, obstacle_contact.body, point, along, normal);
    reaction.x += along;
    reaction.y += normal;
  }
  return reaction;
}

void RunnerForces::add_obstacle(const PlacedRunner& runner,
                                const ContactObstacle& obstacle_contact) {
  const simulation::Obstacle& at = obstacle_contact.obstacle;
  for (const osim::ContactSphere& sphere : model_.spheres) {
    const osim::Vec3 centre = runner.point(sphere.body, sphere.location_m);
    const osim::Vec3 away{centre[0] - at.x_m, centre[1] - at.y_m, centre[2]};
    const double distance = std::sqrt(away[0] * away[0] + away[1] * away[1] + away[2] * away[2]);
    const double depth = at.radius_m + sphere.radius_m - distance;
    if (depth <= 0 || distance <= 0) continue;
    const double nx = away[0] / distance, ny = away[1] / distance;
    const double reach = at.radius_m - depth / 2;  // half-way in depth
    const osim::Vec3 point{at.x_m + nx * reach, at.y_m + ny * reach, 0};
    const simulation::PlanarVector velocity = runner.velocity(sphere.body, point);
    const double radius = at.radius_m * sphere.radius_m / (at.radius_m + sphere.radius_m);
    const double approach = -(velocity.x * nx + velocity.y * ny);
    const double force = std::max(normal_force(obstacle_contact.law, radius, depth, approach), 0.0);
    push(runner, sphere.body, point, force * nx, force * ny);
  }
}

const RunnerForces::Result& RunnerForces::evaluate(const PlacedRunner& runner,
                                                   const double* activation,
                                                   const double* fiber_length_m) {
  std::fill(result_.on_body.begin(), result_.on_body.end(), Wrench{});
  std::fill(result_.on_coordinate.begin(), result_.on_coordinate.end(), 0.0);
  add_gravity(runner);
  for (int i = 0; i < simulation::kMuscles; ++i)
    add_muscle(i, runner, activation[i], fiber_length_m[i]);
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    const simulation::PlanarVector reaction = add_foot(runner, feet_[i]);
    if (i < result_.ground_reaction_N.size()) result_.ground_reaction_N[i] = reaction;
  }
  for (const ContactObstacle& obstacle_contact : contact_obstacles_)
    add_obstacle(runner, obstacle_contact);
  for (std::size_t i = 0; i < joint_limits_.size(); ++i) {
    const int c = joint_limits_[i].coordinate;
    const double torque = limit_force(joint_limits_[i].law, runner.q[c], runner.u[c]);
    result_.on_coordinate[c] += torque;
    if (i < result_.limit_torque_Nm.size()) result_.limit_torque_Nm[i] = torque;
  }
  return result_;
}

}  // namespace stride::laws
