#include "train/simulation/planar/dynamics.h"

#include <utility>

#include "train/simulation/planar/equations.h"
#include "train/simulation/planar/linear.h"
#include "train/simulation/planar/muscles.h"

namespace stride::planar {

using simd::both;
using simd::Pair;
using simd::sum;
using simd::V2;
using simd::V4;

PlanarDynamics::PlanarDynamics(PlanarModel model, const simulation::EngineOptions& options)
    : model_(std::move(model)),
      dropped_(options.drop_contacts ? options.drop_share : 0),
      nominal_obstacles_(options.nominal_obstacles) {
  for (int g = 0; g < kGroups; ++g) max_force_N_[g] = model_.muscles[g].max_force;
  choose_paths();
}

void PlanarDynamics::set_strength(int i, double factor) {
  max_force_N_[i / 4][i % 4] = factor * model_.muscles[i / 4].max_force[i % 4];
}

void PlanarDynamics::set_obstacles(const std::vector<simulation::Obstacle>& obstacles) {
  obstacles_.clear();
  for (const simulation::Obstacle& o : obstacles) {
    const double radius = nominal_obstacles_ ? laws::kNominalObstacleRadius_m : o.radius_m;
    obstacles_.push_back({o.x_m, o.y_m, radius, laws::obstacle_law(radius)});
  }
}

PlanarDynamics::Modes PlanarDynamics::modes_at(const State& state) const {
  Modes modes{};
  for (int m = 0; m < PlanarModel::kMusclesOfLeg; ++m) {
    for (const PlanarModel::Condition& c : model_.paths[m].conditions) {
      for (int leg = 0; leg < kLegs; ++leg) {
        const double angle = state.q(2 * c.joint + leg);
        if (angle >= c.range_min[leg] && angle <= c.range_max[leg]) modes[m][leg] |= c.bit;
      }
    }
  }
  return modes;
}

void PlanarDynamics::set_modes(const Modes& modes) {
  if (modes == modes_) return;
  modes_ = modes;
  choose_paths();
}

void PlanarDynamics::choose_paths() {
  for (int m = 0; m < PlanarModel::kMusclesOfLeg; ++m) {
    for (int leg = 0; leg < kLegs; ++leg) {
      const PlanarModel::Path& from = model_.paths[m].variants[modes_[m][leg]][leg];
      paths_[m].constant_m[leg] = from.constant_m;
      for (std::size_t n = 0; n < from.pieces.size(); ++n) {
        const PlanarModel::Piece& piece = from.pieces[n];
        Piece& to = paths_[m].pieces[n];
        to.inner[leg] = piece.inner, to.outer[leg] = piece.outer;
        to.dz_m[leg] = piece.dz_m, to.weight[leg] = piece.weight, to.moves[leg] = piece.moves;
        for (int j = 0; j < PlanarModel::kJoints; ++j) to.crosses[j][leg] = piece.crosses[j];
      }
    }
  }
}

/// Lengths L and moment arms ∂L/∂q of all muscles, README (7).
void PlanarDynamics::measure_paths(const PlanarKinematics& k, Arms& arms,
                                   std::array<V2, 10>& lengths) const {
  const Pair joint[3] = {k.origin[1], k.hinge, k.origin[3]};
  // Path points in axes of the ground, relative to P.
  Pair at[PlanarModel::kMostPoints];
  const int points = static_cast<int>(model_.points.size());
  for (int i = 0; i < points; ++i) {
    const PlanarModel::Point& p = model_.points[i];
    const Pair local = p.function < 0 ? Pair{p.x_m, p.y_m} : k.moving[p.function];
    at[i] = k.origin[p.segment] + k.turn(p.segment, local);
  }
  for (int m = 0; m < PlanarModel::kMusclesOfLeg; ++m) {
    const PlanarModel::MusclePath& muscle = model_.paths[m];
    V2 length = paths_[m].constant_m;
    std::array<V2, 3>& arm = arms[m];
    arm = {};
    for (int n = 0; n < muscle.pieces; ++n) {
      const Piece& p = paths_[m].pieces[n];
      const auto end = [&](const std::array<int, kLegs>& i) {
        return Pair{V2{at[i[0]].x[0], at[i[1]].x[1]}, V2{at[i[0]].y[0], at[i[1]].y[1]}};
      };
      const Pair outer = end(p.outer), d = outer - end(p.inner);
      const V2 dz = p.dz_m, weight = p.weight;
      const V2 piece = simd::sqrt(dot(d, d) + dz * dz);
      const Pair along = weight / piece * d;  // e, in the plane
      length += weight * piece;
      // (7): (X - J_j) × e for every joint that the piece crosses,
      for (int j = muscle.first_joint; j <= muscle.last_joint; ++j) {
        arm[j] += p.crosses[j] * cross(outer - joint[j], along);
      }
      // and, for a point that moves with the knee, its derivative along e.
      if (muscle.moving >= 0) {
        const PlanarModel::Point& point = model_.points[muscle.moving];
        arm[1] += p.moves * dot(k.turn(point.segment, k.moving_slope[point.function]), along);
      }
    }
    lengths[m] = length;
  }
  lengths[9] = lengths[8];  // fills the last group of four
}

void PlanarDynamics::pull_muscles(const State& state, const Fibers& activation,
                                  const PlanarKinematics& k, State& rate, std::array<V2, 3>& torque,
                                  PlanarLinear* linear) {
  Arms arms;
  std::array<V2, 10> lengths;
  measure_paths(k, arms, lengths);
  for (int g = 0; g < kGroups; ++g) {
    const V4 path = forces_.path_m[g] = simd::join(lengths[2 * g], lengths[2 * g + 1]);
    const PlanarModel::Muscles& muscles = model_.muscles[g];
    const V4 fiber = state.y[State::kFiber + g];
    MuscleGroup r;
    if (linear) {
      r = muscle_group<true>(muscles, activation[g], fiber, path);
      linear->fiber_1_s[g] = r.fiber_1_s;
      linear->stretch_1_s[g] = r.stretch_1_s;
      linear->tendon_N_m[g] = r.tendon_stiffness_n * max_force_N_[g];
      linear->fiber_N_m[g] = linear->tendon_N_m[g] * r.cos_inverse;
    } else {
      r = muscle_group<false>(muscles, activation[g], fiber, path);
    }
    rate.y[State::kFiber + g] = r.fiber_velocity_m_s;
    const V4 tension = forces_.tendon_N[g] = r.tendon_force_n * max_force_N_[g];
    // (7): τ_j = -T ∂L/∂q_j. A group of four holds two muscles of both legs.
    for (int half = 0; half < 2 && 2 * g + half < PlanarModel::kMusclesOfLeg; ++half) {
      const int m = 2 * g + half;
      const V2 pull = half == 0 ? simd::low(tension) : simd::high(tension);
      for (int j = 0; j < 3; ++j) torque[j] -= pull * arms[m][j];
    }
  }
  if (linear) linear->arm = arms;
}

/// Torques of the joint limits. If `linear` is given, adds their stiffness and damping to it.
void PlanarDynamics::push_limits(const State& state, std::array<V2, 3>& torque,
                                 PlanarLinear* linear) const {
  for (const PlanarModel::Limit& limit : model_.limits) {
    const double q = state.q(limit.coordinate);
    if (q <= limit.law.upper && q >= limit.law.lower) continue;
    const int joint = limit.coordinate / 2, leg = limit.coordinate % 2;
    torque[joint][leg] += laws::limit_force(limit.law, q, state.u(limit.coordinate));
    if (!linear) continue;
    const laws::LimitSlopes slopes = laws::limit_slopes(limit.law, q);
    linear->stiffness.at[2 - joint][2 - joint][leg] += slopes.stiffness;
    linear->damping.at[2 - joint][2 - joint][leg] += slopes.damping;
  }
}

void PlanarDynamics::evaluate(const State& state, const Fibers& activation, State& rate,
                              PlanarLinear* linear) {
  if (linear) linear->stiffness = linear->damping = {};
  PlanarKinematics k;
  place(model_, state, interval_, k);
  // The mass matrix comes first: the processor overlaps its chain of divisions with the muscles.
  PlanarEquations equations;
  assemble(model_, k, equations);
  if (linear) linear->mass = equations;
  eliminate(equations);

  std::array<V2, 3> torque{};
  pull_muscles(state, activation, k, rate, torque, linear);
  push_limits(state, torque, linear);
  FootForces feet = touch_ground(model_, state, k, dropped_, linear);
  for (int leg = 0; leg < kLegs; ++leg) forces_.ground_N[leg] = {feet.x[leg], feet.y[leg]};
  if (!obstacles_.empty()) touch_obstacles(model_, obstacles_, state, k, feet, linear);
  load(model_, k, torque, feet, equations);
  solve(equations, rate);
  for (int i = 0; i < State::kU; ++i) rate.y[i] = state.y[State::kU + i];
}

PlanarDynamics::Fibers PlanarDynamics::activation_rate(const Fibers& activation,
                                                       const Fibers& excitation) const {
  Fibers rate;
  for (int g = 0; g < kGroups; ++g) {
    rate[g] = activation_rate_group(model_.muscles[g], activation[g], excitation[g]);
  }
  return rate;
}

PlanarDynamics::Frames PlanarDynamics::frames(const State& state) {
  PlanarKinematics k;
  place(model_, state, interval_, k);
  const Pair pelvis_velocity{both(state.u(7)), both(state.u(8))};
  Pair velocity[4] = {pelvis_velocity, pelvis_velocity + k.omega[0] * perp(k.origin[1])};
  velocity[2] =
      velocity[1] + k.omega[1] * perp(k.origin[2] - k.origin[1]) + k.knee_speed * k.hinge_speed;
  velocity[3] = k.velocity_of_foot;
  Frames frames;
  for (int leg = 0; leg < kLegs; ++leg) {
    double angle = state.q(6);
    for (int i = 0; i < PlanarModel::kSegments; ++i) {
      if (i > 0) angle += state.q(2 * (i - 1) + leg);
      frames[leg][i] = {{state.q(7) + k.origin[i].x[leg], state.q(8) + k.origin[i].y[leg]},
                        {velocity[i].x[leg], velocity[i].y[leg]},
                        angle,
                        k.omega[i][leg]};
    }
  }
  return frames;
}

std::array<double, 81> PlanarDynamics::mass_matrix(const State& state) {
  PlanarKinematics k;
  place(model_, state, interval_, k);
  PlanarEquations legs;
  assemble(model_, k, legs);
  std::array<double, 81> full{};
  const auto set = [&](int i, int j, double value) { full[9 * i + j] = full[9 * j + i] = value; };
  const auto at = [](int i, int leg) { return 2 * (2 - i) + leg; };  // ankle, knee, hip
  for (int leg = 0; leg < kLegs; ++leg) {
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) set(at(i, leg), at(j, leg), legs.matrix[i][j][leg]);
      for (int j = 3; j < 6; ++j) set(at(i, leg), 3 + j, legs.matrix[i][j][leg]);
    }
  }
  const double m = model_.mass_kg[0][0], cx = k.center[0].x[0], cy = k.center[0].y[0];
  set(6, 6, sum(legs.matrix[3][3]) + model_.inertia_kg_m2[0][0] + m * (cx * cx + cy * cy));
  set(6, 7, sum(legs.matrix[3][4]) - m * cy);
  set(6, 8, sum(legs.matrix[3][5]) + m * cx);
  set(7, 7, sum(legs.matrix[4][4]) + m);
  set(8, 8, sum(legs.matrix[5][5]) + m);
  return full;
}

}  // namespace stride::planar
