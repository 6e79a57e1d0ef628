#include "train/simulation/planar_dynamics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "train/simulation/planar_linear.h"
#include "train/simulation/planar_muscles.h"

namespace stride {

using simd::both;
using simd::V2;
using simd::V4;

namespace {

constexpr int kLegs = PlanarModel::kLegs;

/// A vector of the sagittal plane for each leg.
struct Pair {
  V2 x{}, y{};
};
inline Pair operator+(Pair a, Pair b) { return {a.x + b.x, a.y + b.y}; }
inline Pair operator-(Pair a, Pair b) { return {a.x - b.x, a.y - b.y}; }
inline Pair operator*(V2 s, Pair a) { return {s * a.x, s * a.y}; }
inline Pair perp(Pair a) { return {-a.y, a.x}; }  // a quarter turn: z × a
inline V2 dot(Pair a, Pair b) { return a.x * b.x + a.y * b.y; }
inline V2 cross(Pair a, Pair b) { return a.x * b.y - a.y * b.x; }

inline V2 load(const double* p) {
  V2 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(double* p, V2 v) { std::memcpy(p, &v, sizeof v); }
inline double sum(V2 v) { return v[0] + v[1]; }

}  // namespace

/// Positions are relative to the pelvis' origin, in axes of the ground.
struct PlanarDynamics::Kinematics {
  V2 cos[4], sin[4], omega[4];
  Pair origin[4], center[4];
  Pair hinge;        // about which the shank turns in the thigh at this moment
  Pair hinge_speed;  // of the knee's origin in the thigh, per speed of the knee
  Pair hinge_bend;   // its second derivative
  V2 knee_speed;
  Pair velocity_of_foot;  // of its origin in the ground
  // Moving points in the shank, and their derivative by the knee angle.
  std::array<Pair, PlanarModel::kFunctions> moving, moving_slope;

  Pair turn(int segment, Pair v) const {
    return {cos[segment] * v.x - sin[segment] * v.y, sin[segment] * v.x + cos[segment] * v.y};
  }
};

/// The equations of one leg, both legs in lanes: unknowns ankle, knee, hip, tilt, x, y. The base's
/// rows hold this leg's share.
struct PlanarDynamics::Legs {
  V2 matrix[6][6];  // the upper triangle
  V2 right[6];
};

namespace {

/// Adds a spring or damper between the foot's point (relative to the pelvis) and the ground, whose
/// tensor is [xx xy; xy yy].
void add_at_foot(PlanarLinear::Matrix& matrix, const Pair joint[3], Pair point, V2 xx, V2 xy,
                 V2 yy) {
  const Pair column[6] = {perp(point - joint[0]), perp(point - joint[1]),
                          perp(point - joint[2]), perp(point),
                          {both(1), V2{}},        {V2{}, both(1)}};
  for (int i = 0; i < 6; ++i) {
    const Pair w{xx * column[i].x + xy * column[i].y, xy * column[i].x + yy * column[i].y};
    for (int j = i; j < 6; ++j) matrix.at[i][j] += dot(w, column[j]);
  }
}

}  // namespace

PlanarDynamics::PlanarDynamics(PlanarModel model, const EngineOptions& options)
    : model_(std::move(model)),
      drop_contacts_(options.drop_contacts),
      nominal_obstacles_(options.nominal_obstacles) {
  for (int g = 0; g < kGroups; ++g) max_force_N_[g] = model_.muscles[g].max_force;
}

void PlanarDynamics::set_strength(int i, double factor) {
  max_force_N_[i / 4][i % 4] = factor * model_.muscles[i / 4].max_force[i % 4];
}

void PlanarDynamics::set_obstacles(const std::vector<Obstacle>& obstacles) {
  obstacles_.clear();
  for (const Obstacle& o : obstacles) {
    const double radius = nominal_obstacles_ ? kNominalObstacleRadius_m : o.radius_m;
    obstacles_.push_back({o.x_m, o.y_m, radius, obstacle_law(radius)});
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

void PlanarDynamics::place(const State& state, Kinematics& k) {
  const PlanarModel& m = model_;
  const V2 knee = state.joint_q(1);
  const V2 tilt = both(state.q(6));
  const V2 thigh = tilt + state.joint_q(0), shank = thigh + knee, foot = shank + state.joint_q(2);
  V4 s, c;
  simd::sin_cos(V4{tilt[0], tilt[1], thigh[0], thigh[1]}, s, c);
  k.sin[0] = V2{s[0], s[1]}, k.cos[0] = V2{c[0], c[1]};
  k.sin[1] = V2{s[2], s[3]}, k.cos[1] = V2{c[2], c[3]};
  simd::sin_cos(V4{shank[0], shank[1], foot[0], foot[1]}, s, c);
  k.sin[2] = V2{s[0], s[1]}, k.cos[2] = V2{c[0], c[1]};
  k.sin[3] = V2{s[2], s[3]}, k.cos[3] = V2{c[2], c[3]};
  k.knee_speed = state.joint_u(1);
  k.omega[0] = both(state.u(6));
  k.omega[1] = k.omega[0] + state.joint_u(0);
  k.omega[2] = k.omega[1] + k.knee_speed;
  k.omega[3] = k.omega[2] + state.joint_u(2);

  Pair hinge, hinge_slope, hinge_bend;
  for (int leg = 0; leg < kLegs; ++leg) {
    const PlanarModel::KneeTable& table = m.knee[leg];
    const auto interval = [&](double angle) {
      int& i = interval_[leg];
      const int last = static_cast<int>(table.knots.size());
      while (i < last && angle >= table.knots[i]) ++i;
      while (i > 0 && angle < table.knots[i - 1]) --i;
      return i;
    };
    const double clamped = std::clamp(knee[leg], m.knee_range_min[leg], m.knee_range_max[leg]);
    if (clamped != knee[leg]) {
      const PlanarModel::KneeTable::Cubics& f = table.cubics[interval(clamped)];
      const V4 h = simd::all(clamped - f.origin);
      for (int half = 0; half < 2; ++half) {
        const V4 value = f.a[half] + h * (f.b[half] + h * (f.c[half] + h * f.d[half]));
        for (int n = 0; n < 4; n += 2) {
          k.moving[4 * half + n].x[leg] = value[n], k.moving[4 * half + n].y[leg] = value[n + 1];
        }
      }
    }
    const PlanarModel::KneeTable::Cubics& f = table.cubics[interval(knee[leg])];
    const V4 h = simd::all(knee[leg] - f.origin);
    for (int half = 0; half < 2; ++half) {
      const V4 value = f.a[half] + h * (f.b[half] + h * (f.c[half] + h * f.d[half]));
      const V4 slope = f.b[half] + h * (2 * f.c[half] + 3 * h * f.d[half]);
      for (int n = 0; n < 4; n += 2) {
        const int i = 4 * half + n;
        if (clamped == knee[leg]) k.moving[i].x[leg] = value[n], k.moving[i].y[leg] = value[n + 1];
        k.moving_slope[i].x[leg] = slope[n], k.moving_slope[i].y[leg] = slope[n + 1];
      }
      if (half > 0) continue;
      const V4 bend = 2 * f.c[0] + 6 * h * f.d[0];
      hinge.x[leg] = value[0], hinge.y[leg] = value[1];
      hinge_slope.x[leg] = slope[0], hinge_slope.y[leg] = slope[1];
      hinge_bend.x[leg] = bend[0], hinge_bend.y[leg] = bend[1];
    }
  }

  k.origin[0] = {};
  k.origin[1] = k.turn(0, {m.hip_x_m, m.hip_y_m});
  const Pair thigh_to_knee = k.turn(1, hinge);
  k.origin[2] = k.origin[1] + thigh_to_knee;
  const Pair knee_to_ankle = k.turn(2, {m.ankle_x_m, m.ankle_y_m});
  k.origin[3] = k.origin[2] + knee_to_ankle;
  for (int i = 0; i < 4; ++i) {
    k.center[i] = k.origin[i] + k.turn(i, {m.center_x_m[i], m.center_y_m[i]});
  }
  k.hinge_speed = k.turn(1, hinge_slope);
  k.hinge_bend = k.turn(1, hinge_bend);
  k.hinge = k.origin[2] + perp(k.hinge_speed);
  k.velocity_of_foot = Pair{both(state.u(7)), both(state.u(8))} + k.omega[0] * perp(k.origin[1]) +
                       k.omega[1] * perp(thigh_to_knee) + k.knee_speed * k.hinge_speed +
                       k.omega[2] * perp(knee_to_ankle);
}

/// Lengths and moment arms of all muscles.
void PlanarDynamics::measure_paths(const Kinematics& k, Arms& arms,
                                   std::array<V2, 10>& lengths) const {
  const Pair joint[3] = {k.origin[1], k.hinge, k.origin[3]};
  Pair at[PlanarModel::kMostPoints];
  const int points = static_cast<int>(model_.points.size());
  for (int i = 0; i < points; ++i) {
    const PlanarModel::Point& p = model_.points[i];
    const Pair local = p.function < 0 ? Pair{p.x_m, p.y_m} : k.moving[p.function];
    at[i] = k.origin[p.segment] + k.turn(p.segment, local);
  }
  for (int m = 0; m < PlanarModel::kMusclesOfLeg; ++m) {
    const PlanarModel::MusclePath& muscle = model_.paths[m];
    const PlanarModel::Path& first = muscle.variants[modes_[m][0]][0];
    const PlanarModel::Path& second = muscle.variants[modes_[m][1]][1];
    V2 length{first.constant_m, second.constant_m};
    std::array<V2, 3>& arm = arms[m];
    arm = {};
    for (int n = 0; n < muscle.pieces; ++n) {
      const PlanarModel::Piece &a = first.pieces[n], &b = second.pieces[n];
      const Pair outer{V2{at[a.outer].x[0], at[b.outer].x[1]},
                       V2{at[a.outer].y[0], at[b.outer].y[1]}};
      const Pair inner{V2{at[a.inner].x[0], at[b.inner].x[1]},
                       V2{at[a.inner].y[0], at[b.inner].y[1]}};
      const Pair d = outer - inner;
      const V2 dz{a.dz_m, b.dz_m}, weight{a.weight, b.weight};
      const V2 piece = simd::sqrt(dot(d, d) + dz * dz);
      const Pair along = weight / piece * d;
      length += weight * piece;
      for (int j = muscle.first_joint; j <= muscle.last_joint; ++j) {
        arm[j] += V2{a.crosses[j], b.crosses[j]} * cross(outer - joint[j], along);
      }
      if (muscle.moving >= 0) {
        const PlanarModel::Point& p = model_.points[muscle.moving];
        arm[1] += V2{a.moves, b.moves} * dot(k.turn(p.segment, k.moving_slope[p.function]), along);
      }
    }
    lengths[m] = length;
  }
  lengths[9] = lengths[8];
}

void PlanarDynamics::pull_muscles(const State& state, const Fibers& activation, const Kinematics& k,
                                  State& rate, std::array<V2, 3>& torque, PlanarLinear* linear) {
  Arms arms;
  std::array<V2, 10> lengths;
  measure_paths(k, arms, lengths);
  for (int g = 0; g < kGroups; ++g) {
    const V2 a = lengths[2 * g], b = lengths[2 * g + 1];
    const V4 path = forces_.path_m[g] = V4{a[0], a[1], b[0], b[1]};
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
    for (int half = 0; half < 2 && 2 * g + half < PlanarModel::kMusclesOfLeg; ++half) {
      const int m = 2 * g + half;
      const V2 pull{tension[2 * half], tension[2 * half + 1]};
      for (int j = 0; j < 3; ++j) torque[j] -= pull * arms[m][j];
    }
  }
  if (linear) linear->arm = arms;
}

void PlanarDynamics::touch(const State& state, const Kinematics& k, V2& fx, V2& fy, V2& moment,
                           PlanarLinear* linear) {
  fx = fy = moment = V2{};
  forces_.ground_N = {};
  const PlanarModel& m = model_;
  if (m.spheres_of_foot == 0) return;
  const V4 zero{};
  const auto twice = [](V2 v) { return V4{v[0], v[1], v[0], v[1]}; };
  const V4 c = twice(k.cos[3]), s = twice(k.sin[3]);
  const V4 arm_x = c * m.sphere_x_m - s * m.sphere_y_m, arm_y = s * m.sphere_x_m + c * m.sphere_y_m;
  const V4 y = arm_y + twice(k.origin[3].y) + state.q(8);
  const V4 depth = m.sphere_radius_m - (y - m.ground_height_m);
  if (!simd::any(depth > zero)) return;
  const V4 x_in = simd::max(depth, zero);
  const V4 point_y = arm_y - (m.sphere_radius_m - 0.5 * x_in);  // from the foot's origin
  const V4 omega = twice(k.omega[3]);
  const V4 vx = twice(k.velocity_of_foot.x) - omega * point_y;
  const V4 vy = twice(k.velocity_of_foot.y) + omega * arm_x;
  const V4 kx = m.contact.plane_strain_modulus * x_in;
  const V4 hertz = 4.0 / 3 * kx * simd::sqrt(m.sphere_radius_m * kx);
  V4 normal = hertz * (1 - 1.5 * m.contact.dissipation * vy);
  if (drop_contacts_ && m.spheres_of_foot == 2) {
    for (int leg = 0; leg < kLegs; ++leg) {
      const auto center = [&](int i) {
        return Vec3{state.q(7) + k.origin[3].x[leg] + arm_x[i], y[i], m.sphere_z_m[i]};
      };
      const bool in_order = first_sphere_is_swept_first(
          center(leg), m.sphere_radius_m[leg], center(leg + 2), m.sphere_radius_m[leg + 2]);
      const int first = in_order ? leg : leg + 2, second = in_order ? leg + 2 : leg;
      if (depth[first] > 0 && normal[first] <= 0) normal[second] = 0;
    }
  }
  normal = simd::max(normal, zero);
  const V4 slip = vx < zero ? -vx : vx;
  const V4 v = slip / m.contact.transition_velocity_m_s;
  const double us = m.contact.static_friction, ud = m.contact.dynamic_friction;
  V4 mu =
      simd::min(v, simd::all(1)) * (us == ud ? simd::all(ud) : ud + 2 * (us - ud) / (1 + v * v)) +
      m.contact.viscous_friction * slip;
  mu = vx > zero ? -mu : mu;
  const V4 friction = normal * mu;
  const V4 from_x = twice(k.origin[3].x) + arm_x, from_y = twice(k.origin[3].y) + point_y;
  const V4 turning = from_x * normal - from_y * friction;
  fx = V2{friction[0] + friction[2], friction[1] + friction[3]};
  fy = V2{normal[0] + normal[2], normal[1] + normal[3]};
  moment = V2{turning[0] + turning[2], turning[1] + turning[3]};
  for (int leg = 0; leg < kLegs; ++leg) forces_.ground_N[leg] = {fx[leg], fy[leg]};
  if (!linear) return;
  const auto pushes = normal > zero;
  const V4 spring = pushes ? 1.5 * normal / x_in : zero;
  const V4 damper = pushes ? 1.5 * m.contact.dissipation * hertz : zero;
  const V4 brake = v < simd::all(1) ? normal * (us / m.contact.transition_velocity_m_s) : zero;
  const Pair joint[3] = {k.origin[3], k.hinge, k.origin[1]};
  for (int i = 0; i < 2 * m.spheres_of_foot; i += 2) {
    const auto half = [&](V4 f) { return V2{f[i], f[i + 1]}; };
    const Pair point{half(from_x), half(from_y)};
    add_at_foot(linear->stiffness, joint, point, V2{}, V2{}, half(spring));
    add_at_foot(linear->damping, joint, point, half(brake), V2{}, half(damper));
  }
}

void PlanarDynamics::touch_obstacles(const State& state, const Kinematics& k, V2& fx, V2& fy,
                                     V2& moment, PlanarLinear* linear) const {
  const PlanarModel& m = model_;
  for (const Sphere& o : obstacles_) {
    if (std::abs(o.x_m - state.q(7)) > 2 + o.radius_m) continue;  // no foot reaches that far
    for (int i = 0; i < 2 * m.spheres_of_foot; ++i) {
      const int leg = i % 2;
      const double c = k.cos[3][leg], s = k.sin[3][leg];
      const double x = k.origin[3].x[leg] + c * m.sphere_x_m[i] - s * m.sphere_y_m[i];
      const double y = k.origin[3].y[leg] + s * m.sphere_x_m[i] + c * m.sphere_y_m[i];
      const double dx = x + state.q(7) - o.x_m, dy = y + state.q(8) - o.y_m, dz = m.sphere_z_m[i];
      const double reach = m.sphere_radius_m[i] + o.radius_m;
      const double distance2 = dx * dx + dy * dy + dz * dz;
      if (distance2 >= reach * reach || distance2 == 0) continue;
      const double distance = std::sqrt(distance2), depth = reach - distance;
      const double nx = dx / distance, ny = dy / distance;
      // Half-way in depth, on the line of centres; relative to the pelvis.
      const double from = m.sphere_radius_m[i] - depth / 2;
      const double at_x = x - from * nx, at_y = y - from * ny;
      const double vx = k.velocity_of_foot.x[leg] - k.omega[3][leg] * (at_y - k.origin[3].y[leg]);
      const double vy = k.velocity_of_foot.y[leg] + k.omega[3][leg] * (at_x - k.origin[3].x[leg]);
      const double radius = m.sphere_radius_m[i] * o.radius_m / reach;
      const double force = normal_force(o.law, radius, depth, -(vx * nx + vy * ny));
      if (force <= 0) continue;
      fx[leg] += force * nx;
      fy[leg] += force * ny;
      moment[leg] += at_x * force * ny - at_y * force * nx;
      if (!linear) continue;
      V2 spring{};
      spring[leg] = 1.5 * force / depth;
      const Pair joint[3] = {k.origin[3], k.hinge, k.origin[1]};
      add_at_foot(linear->stiffness, joint, {both(at_x), both(at_y)}, nx * nx * spring,
                  nx * ny * spring, ny * ny * spring);
    }
  }
}

void PlanarDynamics::assemble(const Kinematics& k, Legs& legs) const {
  const Pair joint[3] = {k.origin[3], k.hinge, k.origin[1]};  // ankle, knee, hip
  V2 mass{}, second{};  // of all that a joint carries, about the pelvis
  Pair first;
  for (int i = 0; i < 3; ++i) {
    const int segment = 3 - i;
    const V2 m = model_.mass_kg[segment];
    mass += m;
    first = first + m * k.center[segment];
    second += model_.inertia_kg_m2[segment] + m * dot(k.center[segment], k.center[segment]);
    for (int j = i; j < 3; ++j) {
      legs.matrix[i][j] = second - dot(first, joint[i] + joint[j]) + mass * dot(joint[i], joint[j]);
    }
    legs.matrix[i][3] = second - dot(first, joint[i]);
    legs.matrix[i][4] = mass * joint[i].y - first.y;
    legs.matrix[i][5] = first.x - mass * joint[i].x;
  }
  legs.matrix[3][3] = second;
  legs.matrix[3][4] = -first.y;
  legs.matrix[3][5] = first.x;
  legs.matrix[4][4] = mass;
  legs.matrix[4][5] = V2{};
  legs.matrix[5][5] = mass;
}

void PlanarDynamics::evaluate(const State& state, const Fibers& activation, State& rate,
                              PlanarLinear* linear) {
  Kinematics k;
  place(state, k);
  if (linear) linear->stiffness = linear->damping = {};
  std::array<V2, 3> torque{};
  pull_muscles(state, activation, k, rate, torque, linear);
  for (const PlanarModel::Limit& limit : model_.limits) {
    const double q = state.q(limit.coordinate);
    if (q > limit.law.upper || q < limit.law.lower) {
      const double force = limit_force(limit.law, q, state.u(limit.coordinate));
      const int joint = limit.coordinate / 2, leg = limit.coordinate % 2;
      torque[joint][leg] += force;
      if (!linear) continue;
      const LimitSlopes slopes = limit_slopes(limit.law, q);
      linear->stiffness.at[2 - joint][2 - joint][leg] += slopes.stiffness;
      linear->damping.at[2 - joint][2 - joint][leg] += slopes.damping;
    }
  }
  V2 fx, fy, moment;
  touch(state, k, fx, fy, moment, linear);
  if (!obstacles_.empty()) touch_obstacles(state, k, fx, fy, moment, linear);

  // What the segments need beyond the accelerations of the coordinates: m (bias - gravity).
  const auto squared = [&](int i) { return k.omega[i] * k.omega[i]; };
  const Pair gravity{both(model_.gravity_x), both(model_.gravity_y)};
  Pair bias[4];
  bias[1] = -squared(0) * k.origin[1];
  bias[2] = bias[1] - squared(1) * (k.origin[2] - k.origin[1]) +
            2 * k.omega[1] * k.knee_speed * perp(k.hinge_speed) +
            k.knee_speed * k.knee_speed * k.hinge_bend;
  bias[3] = bias[2] - squared(2) * (k.origin[3] - k.origin[2]);

  Legs legs;
  assemble(k, legs);
  Pair force{-fx, -fy};
  V2 turning = -moment;
  const Pair joint[3] = {k.origin[3], k.hinge, k.origin[1]};
  for (int i = 0; i < 3; ++i) {
    const int segment = 3 - i;
    const Pair f =
        model_.mass_kg[segment] *
        (bias[segment] - squared(segment) * (k.center[segment] - k.origin[segment]) - gravity);
    force = force + f;
    turning += cross(k.center[segment], f);
    legs.right[i] = torque[2 - i] - (turning - cross(joint[i], force));
  }
  legs.right[3] = -turning;
  legs.right[4] = -force.x;
  legs.right[5] = -force.y;

  const double m = model_.mass_kg[0][0], cx = k.center[0].x[0], cy = k.center[0].y[0];
  if (linear) {
    std::memcpy(linear->mass.at, legs.matrix, sizeof legs.matrix);
    linear->base_mass_kg = m;
    linear->base_x_m = cx, linear->base_y_m = cy;
    linear->base_inertia_kg_m2 = model_.inertia_kg_m2[0][0];
  }

  // Eliminate ankle, knee and hip of both legs at once.
  V2 inverse[3];
  for (int p = 0; p < 3; ++p) {
    inverse[p] = 1 / legs.matrix[p][p];
    for (int i = p + 1; i < 6; ++i) {
      const V2 factor = legs.matrix[p][i] * inverse[p];
      for (int j = i; j < 6; ++j) legs.matrix[i][j] -= factor * legs.matrix[p][j];
      legs.right[i] -= factor * legs.right[p];
    }
  }
  // The base: its own body and what both legs leave.
  const double w2 = state.u(6) * state.u(6);
  const double f0x = m * (-w2 * cx - model_.gravity_x), f0y = m * (-w2 * cy - model_.gravity_y);
  double a[3][3], b[3];
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) a[i][j] = sum(legs.matrix[3 + i][3 + j]);
    b[i] = sum(legs.right[3 + i]);
  }
  a[0][0] += model_.inertia_kg_m2[0][0] + m * (cx * cx + cy * cy);
  a[0][1] -= m * cy;
  a[0][2] += m * cx;
  a[1][1] += m;
  a[2][2] += m;
  b[0] -= cx * f0y - cy * f0x;
  b[1] -= f0x;
  b[2] -= f0y;
  for (int p = 0; p < 2; ++p) {
    for (int i = p + 1; i < 3; ++i) {
      const double factor = a[p][i] / a[p][p];
      for (int j = i; j < 3; ++j) a[i][j] -= factor * a[p][j];
      b[i] -= factor * b[p];
    }
  }
  double base[3];
  for (int p = 2; p >= 0; --p) {
    double right = b[p];
    for (int j = p + 1; j < 3; ++j) right -= a[p][j] * base[j];
    base[p] = right / a[p][p];
  }
  V2 leg[3];
  for (int p = 2; p >= 0; --p) {
    V2 right = legs.right[p];
    for (int j = p + 1; j < 3; ++j) right -= legs.matrix[p][j] * leg[j];
    for (int j = 0; j < 3; ++j) right -= legs.matrix[p][3 + j] * both(base[j]);
    leg[p] = right * inverse[p];
  }
  for (int i = 0; i < State::kU; ++i) rate.y[i] = state.y[State::kU + i];
  rate.y[State::kU] = V4{leg[2][0], leg[2][1], leg[1][0], leg[1][1]};
  rate.y[State::kU + 1] = V4{leg[0][0], leg[0][1], base[0], base[1]};
  rate.y[State::kU + 2] = V4{base[2], 0, 0, 0};
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
  Kinematics k;
  place(state, k);
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
  Kinematics k;
  place(state, k);
  Legs legs;
  assemble(k, legs);
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

}  // namespace stride
