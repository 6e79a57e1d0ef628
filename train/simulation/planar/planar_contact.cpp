#include "train/simulation/planar/planar_contact.h"

#include <cmath>

#include "train/simulation/planar/linear.h"

namespace stride::planar {

using simd::both;
using simd::Pair;
using simd::V2;
using simd::V4;

namespace {

/// How the foot's point (relative to the pelvis) moves with ankle, knee, hip, tilt, x, y.
struct Columns {
  Columns(const Pair joint[3], Pair point)
      : at{perp(point - joint[0]), perp(point - joint[1]), perp(point - joint[2]), perp(point),
           {both(1), V2{}},        {V2{}, both(1)}} {}
  Pair at[6];
};

/// Adds a spring or damper between that point and the ground, whose tensor is [xx xy; yx yy].
void add_at_foot(PlanarLinear::Matrix& matrix, const Columns& column, V2 xx, V2 xy, V2 yx, V2 yy) {
  for (int j = 0; j < 6; ++j) {
    const Pair c = column.at[j];
    const Pair w{xx * c.x + xy * c.y, yx * c.x + yy * c.y};
    for (int i = 0; i < 6; ++i) matrix.at[i][j] += dot(column.at[i], w);
  }
}

/// A foot that turns or sinks touches with another point, which moves at another velocity: so
/// friction (`brake` N s/m) and damping spring back, too. `arm` goes from the foot's origin to the
/// centre of the sphere, below which it touches.
void add_rolling(PlanarLinear::Matrix& matrix, const Columns& column, const Pair joint[3],
                 Pair point, Pair arm, const PlanarState& state, const PlanarKinematics& k,
                 V2 brake, V2 damper, V2 mu) {
  const Pair pelvis{both(state.u(7)), both(state.u(8))};
  const Pair hip = pelvis + k.omega[0] * perp(k.origin[1]);
  const Pair knee =
      hip + k.omega[1] * perp(k.origin[2] - k.origin[1]) + k.knee_speed * k.hinge_speed;
  const Pair foot = k.velocity_of_foot;
  const Pair carried[4] = {foot, knee, hip, pelvis}, at[4] = {joint[0], joint[1], joint[2], Pair{}};
  Pair slope[6]{};  // of the point's velocity by each coordinate
  for (int j = 0; j < 4; ++j) {
    const V2 sinks = 0.5 * (point.x - at[j].x);  // the point stays half-way in depth
    slope[j].x = carried[j].y - foot.y - k.omega[3] * (arm.x - sinks);
    slope[j].y = foot.x - carried[j].x - k.omega[3] * arm.y;
  }
  slope[5].x = 0.5 * k.omega[3];
  for (int j = 0; j < 6; ++j) {
    const V2 fy = damper * slope[j].y, fx = brake * slope[j].x + mu * fy;
    for (int i = 0; i < 6; ++i) matrix.at[i][j] += column.at[i].x * fx + column.at[i].y * fy;
  }
}

}  // namespace

FootForces touch_ground(const PlanarModel& m, const PlanarState& state, const PlanarKinematics& k,
                        double dropped, PlanarLinear* linear) {
  if (m.spheres_of_foot == 0) return {};
  const V4 zero{};
  const auto twice = [](V2 v) { return V4{v[0], v[1], v[0], v[1]}; };
  const V4 c = twice(k.cos[3]), s = twice(k.sin[3]);
  const V4 arm_x = c * m.sphere_x_m - s * m.sphere_y_m, arm_y = s * m.sphere_x_m + c * m.sphere_y_m;
  const V4 y = arm_y + twice(k.origin[3].y) + state.q(8);
  const V4 depth = m.sphere_radius_m - (y - m.ground_height_m);
  if (!simd::any(depth > zero)) return {};
  const V4 x_in = simd::max(depth, zero);
  const V4 point_y = arm_y - (m.sphere_radius_m - 0.5 * x_in);  // from the foot's origin
  const V4 omega = twice(k.omega[3]);
  const V4 vx = twice(k.velocity_of_foot.x) - omega * point_y;
  const V4 vy = twice(k.velocity_of_foot.y) + omega * arm_x;
  const V4 kx = m.contact.plane_strain_modulus * x_in;
  const V4 hertz = 4.0 / 3 * kx * simd::sqrt(m.sphere_radius_m * kx);
  V4 normal = hertz * (1 - 1.5 * m.contact.dissipation * vy);
  V4 kept = simd::all(1);  // share of the normal force
  if (dropped > 0 && m.spheres_of_foot == 2) {
    for (int leg = 0; leg < PlanarModel::kLegs; ++leg) {
      const auto center = [&](int i) {
        return osim::Vec3{state.q(7) + k.origin[3].x[leg] + arm_x[i], y[i], m.sphere_z_m[i]};
      };
      const bool in_order = laws::first_sphere_is_swept_first(
          center(leg), m.sphere_radius_m[leg], center(leg + 2), m.sphere_radius_m[leg + 2]);
      const int first = in_order ? leg : leg + 2, second = in_order ? leg + 2 : leg;
      if (depth[first] > 0 && normal[first] <= 0) kept[second] = 1 - dropped;
    }
  }
  normal = simd::max(normal, zero) * kept;
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
  const FootForces feet{V2{friction[0] + friction[2], friction[1] + friction[3]},
                        V2{normal[0] + normal[2], normal[1] + normal[3]},
                        V2{turning[0] + turning[2], turning[1] + turning[3]}};
  if (!linear) return feet;
  const auto pushes = normal > zero;
  const V4 spring = pushes ? 1.5 * normal / x_in : zero;
  const V4 damper = pushes ? 1.5 * m.contact.dissipation * hertz * kept : zero;
  const V4 brake = v < simd::all(1) ? normal * (us / m.contact.transition_velocity_m_s) : zero;
  const Pair joint[3] = {k.origin[3], k.hinge, k.origin[1]};
  for (int i = 0; i < 2 * m.spheres_of_foot; i += 2) {
    const auto half = [&](V4 f) { return V2{f[i], f[i + 1]}; };
    const Pair point{half(from_x), half(from_y)};
    const Columns column(joint, point);
    // Friction is mu times the normal force: it changes with the depth as that does.
    add_at_foot(linear->stiffness, column, V2{}, half(mu * spring), V2{}, half(spring));
    add_at_foot(linear->damping, column, half(brake), half(mu * damper), V2{}, half(damper));
    add_rolling(linear->stiffness, column, joint, point, {half(arm_x), half(arm_y)}, state, k,
                half(brake), half(damper), half(mu));
  }
  return feet;
}

void touch_obstacles(const PlanarModel& m, const std::vector<PlanarObstacle>& obstacles,
                     const PlanarState& state, const PlanarKinematics& k, FootForces& feet,
                     PlanarLinear* linear) {
  for (const PlanarObstacle& o : obstacles) {
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
      // At half the depth, on the line of centres; relative to the pelvis.
      const double from = m.sphere_radius_m[i] - depth / 2;
      const double at_x = x - from * nx, at_y = y - from * ny;
      const double vx = k.velocity_of_foot.x[leg] - k.omega[3][leg] * (at_y - k.origin[3].y[leg]);
      const double vy = k.velocity_of_foot.y[leg] + k.omega[3][leg] * (at_x - k.origin[3].x[leg]);
      const double radius = m.sphere_radius_m[i] * o.radius_m / reach;
      const double force = laws::normal_force(o.law, radius, depth, -(vx * nx + vy * ny));
      if (force <= 0) continue;
      feet.x[leg] += force * nx;
      feet.y[leg] += force * ny;
      feet.moment[leg] += at_x * force * ny - at_y * force * nx;
      if (!linear) continue;
      V2 spring{};
      spring[leg] = 1.5 * force / depth;
      const Pair joint[3] = {k.origin[3], k.hinge, k.origin[1]};
      const V2 across = nx * ny * spring;
      add_at_foot(linear->stiffness, {joint, {both(at_x), both(at_y)}}, nx * nx * spring, across,
                  across, ny * ny * spring);
    }
  }
}

}  // namespace stride::planar
